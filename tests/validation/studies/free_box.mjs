// A free box in waves: amplitudes of heave and roll, drift.
import { atMost, reference } from '../harness.mjs';
import { amplitude, line, window } from '../signal.mjs';

const PERIOD = 1.2, HEIGHT = 0.04, END = 11;
const FROM = END - 4 * PERIOD; // ours: waves are there, what the box throws back has not come again from the piston, 8 m and 7 s

function compare(simulate) {
  const measured = (name, column) => {
    const data = reference(`ren2015/${name}.csv`);
    const t = data.column('t_s_local'), y = data.column(column);
    return { t, y, from: t[0], to: t.at(-1) };
  };
  const heave = measured('heave', 'heave_m'), roll = measured('roll', 'roll_deg'), sway = measured('sway', 'sway_m');
  const run = simulate('free_box', { until: END });
  const own = { heave: run.column('box.heave_m'), pitch: run.column('box.pitch_deg'), surge: run.column('box.surge_m'), wave: run.column('before.elevation_m') };
  const of = (m) => amplitude(m.t, m.y, PERIOD, m.from, m.from + Math.floor((m.to - m.from) / PERIOD) * PERIOD);
  const ours = (y) => amplitude(run.time, y, PERIOD, FROM, END);
  const drift = (t, y, from, to) => line(window(t, t, from, to), window(t, y, from, to))[1];
  const theirDrift = drift(sway.t, sway.y, sway.t[0], sway.t[0] + Math.floor((sway.t.at(-1) - sway.t[0]) / PERIOD) * PERIOD);
  const ourDrift = drift(run.time, own.surge, FROM, END);
  const percent = (value, of_) => value / of_ - 1;
  // the moment that lays our heave upon theirs
  const phase = (t, y, from, to) => {
    const w = 2 * Math.PI / PERIOD, x = window(t, t, from, to), v = window(t, y, from, to);
    return Math.atan2(v.reduce((s, a, i) => s + a * Math.sin(w * x[i]), 0), v.reduce((s, a, i) => s + a * Math.cos(w * x[i]), 0)) / w;
  };
  let shift = phase(heave.t, heave.y, heave.from, heave.from + 4 * PERIOD) - phase(run.time, own.heave, FROM, END);
  shift -= PERIOD * Math.ceil((FROM + shift) / PERIOD);
  const moved = run.time.map((t) => t + shift), start = moved.findIndex((t) => t >= 0);
  const panel = (title, y, m, values) => ({ title, x: 't [s]', y, key: 'outside right top', xrange: [0, 4 * PERIOD], curves: [
    { label: 'Ren et al.', style: 'points', x: m.t, y: m.y }, { label: 'simulated', x: moved.slice(start), y: values.slice(start) }] });
  return {
    bars: [
      atMost(`heave amplitude ${(1000 * ours(own.heave)).toFixed(2)} mm, off the measured ${(1000 * of(heave)).toFixed(2)} mm`, percent(ours(own.heave), of(heave)), 0.08, '%'),
      atMost(`roll amplitude ${ours(own.pitch).toFixed(2)} deg, off the measured ${of(roll).toFixed(2)} deg`, percent(ours(own.pitch), of(roll)), 0.08, '%'),
      atMost(`drift ${(1000 * ourDrift).toFixed(1)} mm/s, off the measured ${(1000 * theirDrift).toFixed(1)} mm/s`, percent(ourDrift, theirDrift), 0.2, '%'),
    ],
    notes: [`First harmonic over the last four periods; height of the waves 1.8 m before the box, so measured: ${(2 * ours(own.wave) / HEIGHT).toFixed(3)} of what was asked.`],
    plot: { columns: 1, panels: [panel('heave', 'heave [m]', heave, own.heave),
      panel('roll', 'roll [deg]', roll, own.pitch),
      panel('drift', 'sway [m]', sway, own.surge.map((x) => x - own.surge[start]))] },
  };
}

export const studies = [{
  name: 'free_box',
  title: 'Free box in waves of 0.04 m and 1.2 s',
  reference: 'Ren et al. 2015',
  compare,
}];
