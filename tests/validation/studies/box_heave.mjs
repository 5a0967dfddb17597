// A box in heave against linear theory: its added mass and the waves that it radiates, and how it comes to rest.
import { atMost, holds, sceneOf } from '../harness.mjs';
import { GRAVITY, heaveDecay, heavingBox } from '../potential.mjs';
import { at, fit, largest, mean, swingPeaks, swingPeriod, waveNumber, window } from '../signal.mjs';

const T = 0.9, AMPLITUDE = 0.01, END = 5 * T, OMEGA = 2 * Math.PI / T;
const BOX = { breadth: 0.3, draft: 0.1, depth: 0.4, density: 1000 };
const GAUGES = ['w12', 'w08', 'e08', 'e12'];

/// [mean, along sin, along cos] of the motion's period.
const harmonic = (x, y, from, to) =>
  fit(window(x, x, from, to), window(x, y, from, to), [() => 1, (t) => Math.sin(OMEGA * t), (t) => Math.cos(OMEGA * t)]);

/// Amplitude of the waves [m] that carry away what the damping takes: b w^2 A^2/2 = 2 rho g eta^2/2 c_g.
function radiated(damping) {
  const k = waveNumber(T, BOX.depth, GRAVITY), kd = k * BOX.depth;
  const group = 0.5 * OMEGA / k * (1 + 2 * kd / Math.sinh(2 * kd));
  return OMEGA * AMPLITUDE * Math.sqrt(damping / (2 * BOX.density * GRAVITY * group));
}

function compareForced(simulate) {
  const run = simulate('box_heave', { until: END }), theory = heavingBox(BOX, OMEGA);
  const [level, along, behind] = harmonic(run.time, run.column('box.fluid_fz_n'), 2 * T, END);
  // F = -rho g B z - a z'' - b z' for z = A sin wt
  const spring = BOX.density * GRAVITY * BOX.breadth;
  const mass = (along / AMPLITUDE + spring) / OMEGA ** 2, damping = -behind / (AMPLITUDE * OMEGA);
  const heights = GAUGES.map((gauge) => Math.hypot(...harmonic(run.time, run.column(`${gauge}.elevation_m`), 3 * T, END).slice(1)));
  const wave = radiated(theory.damping), linear = run.time.map((t) => level + AMPLITUDE * ((theory.mass * OMEGA ** 2 - spring) *
    Math.sin(OMEGA * t) - theory.damping * OMEGA * Math.cos(OMEGA * t)));
  return {
    bars: [
      atMost('added mass off linear theory', mass / theory.mass - 1, 0.03, '%'),
      atMost('radiated waves off linear theory, mean of four gauges', mean(heights) / wave - 1, 0.03, '%'),
    ],
    notes: [`Added mass ${mass.toFixed(2)} kg/m, theory ${theory.mass.toFixed(2)}; damping ${damping.toFixed(1)} kg/(m s), of which waves take ${theory.damping.toFixed(1)} by theory: ` +
      'the rest grows with amplitude (1.10, 1.15, 1.26 of theory at 5, 10 and 20 mm, by hand): mostly what the corners shed.',
      `Radiated amplitudes [mm]: ${heights.map((h) => (1000 * h).toFixed(2)).join(', ')}; theory ${(1000 * wave).toFixed(2)}.`],
    plot: { panels: [{ x: 't [s]', y: 'force [N/m]', xrange: [T, END], curves: [
      { label: 'linear theory, once periodic', x: run.time, y: linear, style: 'thin', colour: '#c4501b' },
      { label: 'simulated', x: run.time, y: run.column('box.fluid_fz_n') }] }] },
  };
}

const OFFSET = 0.01, REST = 2, PEAKS = 3;

/// The motion that letting go makes: less how a box bobs that is let go where it should rest, which a tank's zero has in it.
function compareDecay(simulate) {
  const run = simulate('box_decay', { until: REST }), alone = simulate('box_decay', { until: REST, set: ['bodies.box.initial_offset.heave_m=0'] });
  const theory = heaveDecay(BOX, OFFSET, REST), mm = (z) => (1000 * z).toFixed(2);
  const heave = run.column('box.heave_m'), bob = alone.column('box.heave_m'), dp = sceneOf('box_decay').fluid.spacing_m;
  const swing = heave.map((z, i) => z - at(alone.time, bob, run.time[i]));
  const own = swingPeaks(run.time, swing, PEAKS), expected = swingPeaks(theory.t, theory.z, PEAKS);
  const times = [swingPeriod(run.time, swing), swingPeriod(theory.t, theory.z)];
  return {
    bars: [atMost('period off linear theory', times[0] / times[1] - 1, 0.03, '%'), ...own.map((z, k) =>
      holds(`extreme ${k + 1} [mm]`, mm(z), `within 10 % of ${mm(expected[k])}`, Math.abs(z / expected[k] - 1) <= 0.1)),
    atMost('heave of the box left alone, mean from 1 s on, of dp', mean(window(alone.time, bob, 1, REST)) / dp, 0.25)],
    notes: [`Period ${times[0].toFixed(3)} s, by theory ${times[1].toFixed(3)} s. Left alone the box bobs by ${mm(largest(bob))} mm at most and rests too high; that is taken off.`],
    plot: { panels: [{ x: 't [s]', y: 'heave [m]', xrange: [0, REST], curves: [
      { label: 'linear theory', x: theory.t, y: theory.z, style: 'thin', colour: '#c4501b' },
      { label: 'simulated, less how the box bobs alone', x: run.time, y: swing },
      { label: 'the box alone', x: alone.time, y: bob, style: 'thin', colour: '#999999' }] }] },
  };
}

export const studies = [{
  name: 'box_heave',
  title: 'Box in forced heave, 2-D',
  reference: 'linear potential theory (Lee 1995), computed here',
  compare: compareForced,
}, {
  name: 'box_decay',
  title: 'Heave decay of a floating box, 2-D',
  reference: 'linear potential theory (Lee 1995; Cummins 1962), computed here',
  compare: compareDecay,
}];
