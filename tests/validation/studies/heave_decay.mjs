// A body let go above its rest: period and first extremes against other codes.
import { atMost, holds, reference } from '../harness.mjs';
import { at, mean, swingPeaks, swingPeriod } from '../signal.mjs';

const END = 10, PEAKS = 3, LAST = END - 0.5;
const CODES = ['ProteusDS_Lin', 'InWave_Lin', 'Marin_NLin', 'NREL_CFD', 'WavEC_Lin', 'InWave+H_Lin'];

function compare(simulate) {
  const data = reference('oes_task10/decay_1m.csv');
  const t = data.column('t_s'), codes = CODES.map((name) => ({ label: name, x: t, y: data.column(name) }));
  const middle = t.map((_, i) => mean(codes.map((c) => c.y[i])));
  const run = simulate('sphere_decay', { until: END });
  const heave = run.column('sphere.heave_m');
  const own = swingPeaks(run.time, heave, PEAKS), theirs = codes.map((c) => swingPeaks(c.x, c.y, PEAKS));
  const bars = [atMost('period off the mean of six codes', swingPeriod(run.time, heave, LAST) / swingPeriod(t, middle, LAST) - 1, 0.03, '%')];
  for (let k = 0; k < PEAKS; k++) {
    const all = theirs.map((p) => p[k]), expected = mean(all), error = own[k] / expected - 1;
    bars.push(holds(`extreme ${k + 1} [m]`, own[k].toFixed(3), `within 10 % of ${expected.toFixed(3)}; the codes: ${Math.min(...all).toFixed(3)} to ${Math.max(...all).toFixed(3)}`,
      Math.abs(error) <= 0.1));
  }
  return {
    bars,
    notes: [`Period ${swingPeriod(run.time, heave, LAST).toFixed(3)} s; the codes: ${codes.map((c) => swingPeriod(c.x, c.y, LAST).toFixed(3)).join(', ')} s. Largest difference from their mean, of the release: ` +
      `${(100 * Math.max(...run.time.map((s, i) => (s < END - 0.1 && s > 0.02 ? Math.abs(heave[i] - at(t, middle, s)) : 0)))).toFixed(1)} %.`],
    plot: { panels: [{ x: 't [s]', y: 'heave [m]', xrange: [0, END], curves: [
      ...codes.map((c, k) => ({ ...c, style: 'thin', colour: ['#bbbbbb', '#999999', '#c4501b', '#2b8a3e', '#777777', '#555555'][k] })),
      { label: 'simulated', x: run.time, y: heave }] }] },
  };
}

export const studies = [{
  name: 'sphere_decay',
  title: 'Heave decay of a sphere of radius 5 m from 1 m',
  reference: 'IEA OES Task 10',
  compare,
}];
