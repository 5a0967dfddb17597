// A standing wave in a thick fluid: what viscosity takes, beside what stepping and spacing take. Height decays by 2 nu k^2, less the
// share sqrt(nu k^2/2 omega) by the next power of nu in the dispersion relation of Lamb (1932), section 349.
import { atMost } from '../harness.mjs';
import { extremes, line } from '../signal.mjs';

const GRAVITY = 9.81, LENGTH = 1, DEPTH = 0.5, PERIODS = 6, VISCOSITY = 5e-3;

function decay(simulate, until, set) {
  const run = simulate('viscous_wave', { until, set });
  const low = run.column('low.elevation_m'), high = run.column('high.elevation_m');
  const swing = low.map((z, i) => z - high[i]); // even harmonics, which are bound, cancel
  const tops = extremes(run.time, swing);
  return { time: run.time, swing, rate: -line(tops.map((p) => p.x), tops.map((p) => Math.log(Math.abs(p.y))))[1] };
}

function compare(simulate) {
  const k = Math.PI / LENGTH, omega = Math.sqrt(GRAVITY * k * Math.tanh(k * DEPTH)), period = 2 * Math.PI / omega;
  const thick = decay(simulate, PERIODS * period, []), none = decay(simulate, PERIODS * period, ['fluid.viscosity_m2s=0']);
  const expected = 2 * VISCOSITY * k * k * (1 - Math.sqrt(VISCOSITY * k * k / (2 * omega))), start = Math.abs(thick.swing[0]);
  return {
    bars: [atMost('rate of decay less that without viscosity, off Lamb', (thick.rate - none.rate) / expected - 1, 0.05, '%')],
    notes: [`Rates of height: ${thick.rate.toFixed(4)} /s, without viscosity ${none.rate.toFixed(4)} /s; expected ${expected.toFixed(4)} /s.`],
    plot: { panels: [{ x: 't/T [-]', y: 'elevation, ends of the tank apart [m]', key: 'top right', curves: [
      { label: 'simulated', x: thick.time.map((t) => t / period), y: thick.swing },
      { label: 'without viscosity', style: 'thin', colour: '#9cc3e6', x: none.time.map((t) => t / period), y: none.swing },
      { label: 'decay expected and what is lost without', style: 'dashed', x: thick.time.map((t) => t / period),
        y: thick.time.map((t) => start * Math.exp(-(expected + none.rate) * t)) }] }] },
  };
}

export const studies = [{
  name: 'viscous_wave',
  title: 'Standing wave in a thick fluid',
  reference: 'Lamb 1932',
  compare,
}];
