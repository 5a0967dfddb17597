// Dam break against a box, SPHERIC test 2: heights and impulses of pressures.
import { holds, atMost, reference } from '../harness.mjs';
import { at, integral, rms } from '../signal.mjs';

const END = 6, DEPTH = 0.55;

function compare(simulate) {
  const data = reference('spheric2/kleefsman.csv'), t = data.column('t_s');
  const run = simulate('kleefsman', { until: END });
  const bars = [], panels = [];
  for (let k = 1; k <= 4; k++) {
    const theirs = data.column(`H${k}_m`), ours = run.column(`H${k}.elevation_m`).map((z) => (Number.isFinite(z) ? z : 0));
    const errors = t.map((s, i) => theirs[i] - at(run.time, ours, s)).filter(Number.isFinite);
    bars.push(atMost(`H${k}, rms of ${DEPTH} m`, rms(errors) / DEPTH, 0.08, '%'));
    panels.push({ title: `H${k}`, x: 't [s]', y: 'height [m]', xrange: [0, END], curves: [
      { label: 'measured', style: 'thin', x: t, y: theirs }, { label: 'simulated', x: run.time, y: ours }] });
  }
  for (let k = 1; k <= 8; k++) {
    const theirs = data.column(`P${k}_Pa`), ours = run.column(`P${k}.pressure_pa`);
    const measured = integral(t, theirs, 0, END), found = integral(run.time, ours, 0, END);
    const error = found / measured - 1;
    bars.push(holds(`P${k}, impulse`, `${found.toFixed(0)} Pa s, ${(100 * error).toFixed(1)} %`, `within 10 % of ${measured.toFixed(0)} Pa s`, Math.abs(error) <= 0.1));
    panels.push({ title: `P${k}`, x: 't [s]', y: 'pressure [kPa]', xrange: [0, END], yrange: [-0.5, k <= 4 ? 12 : 4], curves: [
      { label: 'measured', style: 'thin', x: t, y: theirs.map((p) => p / 1000) },
      { label: 'simulated', x: run.time, y: ours.map((p) => p / 1000) }] });
  }
  return { bars, plot: { columns: 2, panels } };
}

export const studies = [{
  name: 'kleefsman',
  title: 'Dam break against a box',
  reference: 'Kleefsman et al. 2005 (SPHERIC test 2)',
  compare,
}];
