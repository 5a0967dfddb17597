// A free box in waves: amplitudes of heave and roll, drift.
import { atMost, reference } from '../harness.mjs';
import { swing } from '../signal.mjs';

const PERIOD = 1.2, HEIGHT = 0.04, END = 16;
const FROM = END - 4 * PERIOD; // ours: waves are there, what the box throws back has not come again from the piston, 12 m and 10.7 s
// Linear potential flow, this box free in sway, heave and roll: eigenfunctions matched under and beside it as in
// potential.mjs, 60 of each; Haskind's relation and R^2 + T^2 = 1 hold to 1e-4.
const LINEAR = { sway: 0.0184, heave: 0.0248, roll: 2.14 };

const amounts = (sway, heave, roll) => `${(1000 * sway).toFixed(1)} mm, ${(1000 * heave).toFixed(1)} mm, ${roll.toFixed(2)} deg`;

function compare(simulate) {
  const measured = (name, column) => {
    const data = reference(`ren2015/${name}.csv`), t = data.column('t_s_local'), y = data.column(column);
    return { t, y, ...swing(t, y, PERIOD, t[0], t[0] + Math.floor((t.at(-1) - t[0]) / PERIOD) * PERIOD) };
  };
  const theirs = { sway: measured('sway', 'sway_m'), heave: measured('heave', 'heave_m'), roll: measured('roll', 'roll_deg') };
  const run = simulate('free_box', { until: END });
  const simulated = (name) => ({ y: run.column(name), ...swing(run.time, run.column(name), PERIOD, FROM, END) });
  const ours = { sway: simulated('box.surge_m'), heave: simulated('box.heave_m'), roll: simulated('box.pitch_deg'), wave: simulated('before.elevation_m') };
  const turn = 2 * Math.PI, lead = (m) => (((m.sway.phase - m.roll.phase) / turn + 1.5) % 1 - 0.5) * 360; // of roll before sway [deg]
  const all = (m) => amounts(m.sway.amplitude, m.heave.amplitude, m.roll.amplitude);
  // the moment that lays our heave upon theirs
  let shift = (theirs.heave.phase - ours.heave.phase) / turn * PERIOD;
  shift -= PERIOD * Math.ceil((FROM + shift) / PERIOD);
  const moved = run.time.map((t) => t + shift), start = moved.findIndex((t) => t >= 0);
  const panel = (title, y, m, values) => ({ title, x: 't [s]', y, key: 'outside right top', xrange: [0, 4 * PERIOD], curves: [
    { label: 'Ren et al.', style: 'points', x: m.t, y: m.y }, { label: 'simulated', x: moved.slice(start), y: values.slice(start) }] });
  const bar = (what, factor, digits, unit, mine, measure, limit) => atMost(`${what} ${(factor * mine).toFixed(digits)} ${unit}, off the measured ` +
    `${(factor * measure).toFixed(digits)} ${unit}`, mine / measure - 1, limit, '%');
  return {
    bars: [
      bar('heave amplitude', 1000, 2, 'mm', ours.heave.amplitude, theirs.heave.amplitude, 0.08),
      bar('roll amplitude', 1, 2, 'deg', ours.roll.amplitude, theirs.roll.amplitude, 0.08),
      bar('drift', 1000, 1, 'mm/s', ours.sway.drift, theirs.sway.drift, 0.2),
    ],
    notes: [`Amplitudes of sway, heave, roll: simulated ${all(ours)}; measured ${all(theirs)}; linear potential flow ${amounts(LINEAR.sway, LINEAR.heave, LINEAR.roll)}. ` +
      `Roll leads sway by ${lead(ours).toFixed(0)} deg, measured ${lead(theirs).toFixed(0)}, without friction 0.`,
      `First harmonic over the last four periods; height of the waves 1.8 m before the box, so measured: ${(2 * ours.wave.amplitude / HEIGHT).toFixed(3)} of what was asked.`],
    plot: { columns: 1, panels: [panel('heave', 'heave [m]', theirs.heave, ours.heave.y),
      panel('roll', 'roll [deg]', theirs.roll, ours.roll.y),
      panel('drift', 'sway [m]', theirs.sway, ours.sway.y.map((x) => x - ours.sway.y[start]))] },
  };
}

export const studies = [{
  name: 'free_box',
  title: 'Free box in waves of 0.04 m and 1.2 s',
  reference: 'Ren et al. 2015',
  compare,
}];
