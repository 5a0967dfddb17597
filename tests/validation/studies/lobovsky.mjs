// Pressure of a dam break on the wall against the percentiles of a hundred repeats.
import { atLeast, holds, reference } from '../harness.mjs';
import { at, mean } from '../signal.mjs';

const GRAVITY = 9.81, HEIGHT = 0.3, END = 1.24;
const SCALE = Math.sqrt(GRAVITY / HEIGHT), WEIGHT = 1000 * GRAVITY * HEIGHT;
const RISE = 0.8; // of rho g H: the impact has come
const WINDOW = 0.06; // in t sqrt(g/H): the running median that stands for that of many runs

function runningMedian(x, y, width) {
  let from = 0, to = 0;
  return x.map((t) => {
    while (x[from] < t - width / 2) from++;
    while (to < x.length && x[to] <= t + width / 2) to++;
    const sorted = y.slice(from, to).sort((a, b) => a - b);
    return sorted[sorted.length >> 1];
  });
}

function compare(simulate) {
  const data = reference('lobovsky2014/sensor2_percentiles.csv');
  const [t, low, median, high] = data.names.map(data.column);
  const run = simulate('lobovsky', { until: END });
  const time = run.time.map((s) => s * SCALE);
  const pressure = run.column('sensor2.pressure_pa').map((p) => p / WEIGHT);
  const smooth = runningMedian(time, pressure, WINDOW);
  const arrival = time[pressure.findIndex((p) => p > RISE)], expected = t[median.findIndex((p) => p > RISE)];
  const shift = expected - arrival;
  const peak = t[median.indexOf(Math.max(...median))];
  const after = time.map((_, i) => i).filter((i) => time[i] + shift > peak && time[i] + shift < t.at(-1));
  const inside = after.map((i) => smooth[i] >= at(t, low, time[i] + shift) && smooth[i] <= at(t, high, time[i] + shift));
  const plateau = (x, y) => mean(y.filter((_, i) => x[i] > 3.8 && x[i] < 5.4));
  return {
    bars: [atLeast('time after the peak inside the 2.5 to 97.5 % band', mean(inside.map(Number)), 0.9, '%'),
      holds('impact, t sqrt(g/H)', arrival.toFixed(3), `measured ${expected.toFixed(3)}, within 5 %`, Math.abs(shift) < 0.05 * expected)],
    notes: [`Running median over ${WINDOW} of t sqrt(g/H), laid upon the measured moment of impact. On the plateau, 3.8 to 5.4, it is ` +
      `${plateau(time, smooth).toFixed(2)} rho g H, measured ${plateau(t, median).toFixed(2)}. Water without friction gives as much: by Ritter's dry dam break the stagnation pressure ` +
      'of the stream is 0.85 at 4.5. Friction at the walls, as far as it is modelled, does not change it (top of this page).'],
    plot: { panels: [{ x: 't sqrt(g/H) [-]', y: 'pressure / (rho g H) [-]', xrange: [2.3, 7], yrange: [-0.1, 3], curves: [
      { label: '2.5 to 97.5 % of the measurements', style: 'band', x: t, low, high },
      { label: 'median of the measurements', style: 'dashed', x: t, y: median },
      { label: 'simulated', style: 'thin', colour: '#9cc3e6', x: time.map((s) => s + shift), y: pressure },
      { label: 'simulated, running median', x: time.map((s) => s + shift), y: smooth }] }] },
  };
}

export const studies = [{
  name: 'lobovsky',
  title: 'Pressure of a dam break on the wall, 15 mm above the bed',
  reference: 'Lobovsky et al. 2014',
  compare,
}];
