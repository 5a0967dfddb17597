// Regular waves over two wave lengths of a 2-D basin or flume, and the same wave over headings, against stream-function
// waves that carry nothing (docs/physics.md, waves).
import { atMost, reference, sceneOf } from '../harness.mjs';
import { fit, largest, mean, smallest, window } from '../signal.mjs';

const PERIODS = 6; // at the end of a run, that are looked at

/// What flows along the waves [m/s].
function currentAlong({ current, heading_deg: heading = 0 }) {
  return current ? current.speed_ms * Math.cos((heading - (current.heading_deg ?? 0)) * Math.PI / 180) : 0;
}

/// The row of the reference waves with this height and period; on a current the wave that has it in the water, where
/// its length over c + U is the period of a fixed place. c_m_s is then c + U.
function referenceWave(waves, depth) {
  const table = reference('stokes_fenton/waves_without_transport.csv'), flows = currentAlong(waves);
  const rows = table.column('H_m').map((_, i) => Object.fromEntries(table.names.map((key) => [key, table.column(key)[i]])));
  const row = rows.find((wave) => wave.H_m === waves.height_m && wave.d_m === depth &&
    (flows ? Math.abs(wave.lambda_m / (wave.c_m_s + flows) / waves.period_s - 1) < 1e-5 : wave.T_s === waves.period_s));
  return { ...row, c_m_s: row.c_m_s + flows };
}

/// Height, crest and complex amplitude of the mean wave at a gauge over the last periods: five harmonics. Single crests
/// carry the noise of particles, which would count as height.
function gaugeWave(run, name, period, count = PERIODS) {
  const end = run.time.at(-1), from = end - count * period, w = 2 * Math.PI / period, harmonics = [1, 2, 3, 4, 5];
  const t = window(run.time, run.time, from, end), eta = window(run.time, run.column(`${name}.elevation_m`), from, end);
  const c = fit(t, eta, [() => 1, ...harmonics.flatMap((j) => [(s) => Math.cos(j * w * s), (s) => Math.sin(j * w * s)])]);
  const wave = Array.from({ length: 100 }, (_, n) => harmonics.reduce((sum, j) => sum +
    c[2 * j - 1] * Math.cos(j * 2 * Math.PI * n / 100) + c[2 * j] * Math.sin(j * 2 * Math.PI * n / 100), 0));
  return { height: largest(wave) - smallest(wave), crest: largest(wave), level: c[0], real: c[1], imaginary: c[2] };
}

/// Least squares a exp(ikx - m x) + b exp(-ikx) over gauges for one k and m. @return residual and |b/a|
function separate(xs, waves, k, m) {
  let uu = 0, vv = 0, uvr = 0, uvi = 0, ur = 0, ui = 0, vr = 0, vi = 0;
  xs.forEach((x, i) => {
    const e = Math.exp(-m * x), c = Math.cos(k * x), s = Math.sin(k * x), { real, imaginary } = waves[i];
    uu += e * e;
    vv += 1;
    uvr += e * (c * c - s * s); // conj(u) v = e exp(-2ikx)
    uvi -= e * 2 * c * s;
    ur += e * (c * real + s * imaginary);
    ui += e * (c * imaginary - s * real);
    vr += c * real - s * imaginary;
    vi += c * imaginary + s * real;
  });
  const det = uu * vv - uvr * uvr - uvi * uvi;
  const a = [(vv * ur - (uvr * vr - uvi * vi)) / det, (vv * ui - (uvr * vi + uvi * vr)) / det];
  const b = [(uu * vr - (uvr * ur + uvi * ui)) / det, (uu * vi - (uvr * ui - uvi * ur)) / det];
  let residual = 0;
  xs.forEach((x, i) => {
    const e = Math.exp(-m * x), c = Math.cos(k * x), s = Math.sin(k * x);
    residual += (waves[i].real - e * (a[0] * c - a[1] * s) - (b[0] * c + b[1] * s)) ** 2 +
      (waves[i].imaginary - e * (a[0] * s + a[1] * c) - (b[1] * c - b[0] * s)) ** 2;
  });
  return { residual, reflection: Math.hypot(...b) / Math.hypot(...a), k, m };
}

/// The k and loss per metre that fit best, by ever finer grids.
function bestFit(xs, waves, guess) {
  let best = separate(xs, waves, guess, 0), dk = 0.01 * guess, dm = 0.02;
  for (let round = 0; round < 6; round++, dk /= 3, dm /= 3) {
    const { k, m } = best;
    for (let i = -6; i <= 6; i++)
      for (let j = -6; j <= 6; j++) {
        const tried = separate(xs, waves, k + i * dk, m + j * dm);
        if (tried.residual < best.residual) best = tried;
      }
  }
  return best;
}

function compareLine(name, until, simulate) {
  const scene = sceneOf(name), period = scene.waves.period_s, depth = -scene.domain.min_m.at(-1);
  const wave = referenceWave(scene.waves, depth), run = simulate(name, { until });
  const xs = scene.probes.gauges.map((gauge) => gauge.x_m);
  const gauges = scene.probes.gauges.map((gauge) => gaugeWave(run, gauge.name, period));
  const ratios = gauges.map((gauge) => gauge.height / wave.H_m);
  const fitted = bestFit(xs, gauges, 2 * Math.PI / wave.lambda_m);
  const speed = 2 * Math.PI / period / fitted.k, last = (key) => run.column(key).at(-1);
  const worst = ratios.reduce((a, b) => (Math.abs(b - 1) > Math.abs(a - 1) ? b : a));
  const percent = (x) => `${(100 * x).toFixed(1)} %`;
  return {
    bars: [
      atMost('height less asked, worst of 17 gauges over 4 m', worst - 1, 0.03, '%'),
      atMost('phase speed less reference', speed / wave.c_m_s - 1, 0.01, '%'),
      atMost('reflection', fitted.reflection, 0.03, '%'),
      atMost('particles lost behind the walls', run.summary.health.lost_particles, 0),
    ],
    notes: [
      `H/L ${(wave.H_m / wave.lambda_m).toFixed(3)}, kd ${(2 * Math.PI * depth / wave.lambda_m).toFixed(2)}, ` +
        `H/dp ${(wave.H_m / scene.fluid.spacing_m).toFixed(1)}; L ${wave.lambda_m} m, c ${wave.c_m_s} m/s; last ${PERIODS} periods of ${until} s.`,
      `Mean height ${percent(mean(ratios))} of asked, loss ${percent(1 - Math.exp(-fitted.m * wave.lambda_m))} per wave length, gain ` +
        `${last('wave_quality.gain').toFixed(3)}, crests ${percent(mean(gauges.map((g) => g.crest)) / wave.eta_crest_m)} of the reference, ` +
        (Number.isFinite(last('wave_quality.reflection')) ? `reflection by three gauges ${percent(last('wave_quality.reflection'))}.` : 'the run is too short for the live reading of the reflection.'),
    ],
    plot: { columns: 2, panels: [
      { x: 'x [m]', y: 'height over asked', title: 'height along the way', yrange: [0.94, 1.08], curves: [
        ...[0.97, 1.03].map((y) => ({ label: y < 1 ? '' : 'bar', x: [xs[0], xs.at(-1)], y: [y, y], style: 'dashed' })),
        { label: 'measured', x: xs, y: ratios, style: 'points', colour: '#0b5fa5' }] },
      { x: 't [s]', y: 'elevation [m]', title: 'middle gauge, last periods', yrange: [1.4 * wave.eta_trough_m, 1.9 * wave.eta_crest_m], curves: [
        { label: 'crest, trough of the reference', x: [run.time.at(-1) - 3 * period, run.time.at(-1)], y: [wave.eta_crest_m, wave.eta_crest_m], style: 'dashed' },
        { x: [run.time.at(-1) - 3 * period, run.time.at(-1)], y: [wave.eta_trough_m, wave.eta_trough_m], style: 'dashed' },
        { label: 'measured', x: window(run.time, run.time, run.time.at(-1) - 3 * period, Infinity),
          y: window(run.time, run.column('g8.elevation_m'), run.time.at(-1) - 3 * period, Infinity), colour: '#0b5fa5' }] }] },
  };
}

const HEADINGS = [0, 30, 45, 90];

function compareHeadings(simulate) {
  const name = 'waves_headings', scene = sceneOf(name), period = scene.waves.period_s, until = 7.2;
  const wave = referenceWave(scene.waves, scene.domain.depth_m), ratios = [], speeds = [];
  for (const heading of HEADINGS) {
    const run = simulate(name, { until, set: [`waves.heading_deg=${heading}`] });
    const gauges = scene.probes.gauges.map((gauge) => gaugeWave(run, gauge.name, period, 4));
    const c = Math.cos(heading * Math.PI / 180), s = Math.sin(heading * Math.PI / 180);
    const along = scene.probes.gauges.map((gauge) => gauge.x_m * c + gauge.y_m * s);
    ratios.push(mean(gauges.map((gauge) => gauge.height)) / wave.H_m);
    speeds.push(2 * Math.PI / period / bestFit(along, gauges, 2 * Math.PI / wave.lambda_m).k / wave.c_m_s);
  }
  const middle = mean(ratios), far = (values) => values.reduce((a, b) => (Math.abs(b - 1) > Math.abs(a - 1) ? b : a));
  return {
    bars: [
      atMost('spread of heights over headings, (largest - smallest)/mean', (largest(ratios) - smallest(ratios)) / middle, 0.02, '%'),
      atMost('height less asked, worst heading', far(ratios) - 1, 0.03, '%'),
      atMost('phase speed less reference over 0.8 m, worst heading', far(speeds) - 1, 0.01, '%'),
    ],
    notes: [`Headings ${HEADINGS.join(', ')} deg: height over asked ${ratios.map((r) => r.toFixed(3)).join(', ')}; ` +
      `speed over reference ${speeds.map((r) => r.toFixed(3)).join(', ')}; mean of nine gauges, last 4 periods of ${until} s; H/dp ${(wave.H_m / scene.fluid.spacing_m).toFixed(0)}, no gain.`],
    plot: { columns: 1, panels: [{ x: 'heading [deg]', y: 'over asked, over reference', title: 'height and speed', curves: [
      { label: 'height', x: HEADINGS, y: ratios, style: 'points', colour: '#0b5fa5' },
      { label: 'speed', x: HEADINGS, y: speeds, style: 'points', colour: '#c74a2e' }] }] },
  };
}

const LINES = [['intermediate_07', 20, 16], ['intermediate_03', 20, 20], ['deep_07', 20, 18], ['deep_03', 20, 18]];
const SOURCE = 'stream function without transport, tests/data/stokes_fenton';

export const studies = [
  ...LINES.flatMap(([which, basin, flume]) => [['basin', basin], ['flume', flume]].map(([kind, until]) => ({
    name: `waves_${kind}_${which}`,
    title: sceneOf(`waves_${kind}_${which}`).title,
    reference: SOURCE,
    compare: (simulate) => compareLine(`waves_${kind}_${which}`, until, simulate),
  }))),
  ...['with', 'against'].map((way) => ({
    name: `waves_current_${way}`,
    title: sceneOf(`waves_current_${way}`).title,
    reference: `${SOURCE}, Galileo`,
    compare: (simulate) => compareLine(`waves_current_${way}`, 20, simulate),
  })),
  { name: 'waves_headings', title: 'The same wave over headings in a 3-D basin', reference: SOURCE, compare: compareHeadings },
];
