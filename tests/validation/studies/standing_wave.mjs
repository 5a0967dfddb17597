// A standing wave let go: frequency by crossings, decay by extremes.
import { atMost } from '../harness.mjs';
import { crossings, extremes, line, smallest } from '../signal.mjs';

const GRAVITY = 9.81, LENGTH = 1, DEPTH = 0.5, PERIODS = 10;

function compare(simulate) {
  const k = Math.PI / LENGTH, omega = Math.sqrt(GRAVITY * k * Math.tanh(k * DEPTH)), period = 2 * Math.PI / omega;
  const run = simulate('standing_wave', { until: PERIODS * period });
  const low = run.column('low.elevation_m'), high = run.column('high.elevation_m');
  const swing = low.map((z, i) => z - high[i]); // even harmonics, which are bound, cancel
  const zero = crossings(run.time, swing);
  const found = 2 * (zero.at(-1) - zero[0]) / (zero.length - 1);
  const tops = extremes(run.time, swing);
  const rate = line(tops.map((p) => p.x / period), tops.map((p) => Math.log(Math.abs(p.y))))[1];
  return {
    bars: [
      atMost('frequency off the dispersion relation', period / found - 1, 0.01, '%'),
      atMost('loss of height a period', 1 - Math.exp(rate), 0.015, '%'),
    ],
    notes: [`Decay is fitted to all ${tops.length} extremes; least of them ${smallest(tops.map((p) => Math.abs(p.y))).toFixed(4)} m of ${Math.abs(tops[0].y).toFixed(4)} m.`],
    plot: { panels: [{ x: 't/T [-]', y: 'elevation, ends of the tank apart [m]', key: 'bottom left', curves: [
      { label: 'simulated', x: run.time.map((t) => t / period), y: swing },
      { label: 'cos omega t of the dispersion relation, first extreme', style: 'dashed', x: run.time.map((t) => t / period),
        y: run.time.map((t) => Math.abs(swing[0]) * Math.cos(omega * t)) }] }] },
  };
}

export const studies = [{
  name: 'standing_wave',
  title: 'Standing wave over ten periods, h/dp 2',
  reference: 'linear dispersion',
  compare,
}];
