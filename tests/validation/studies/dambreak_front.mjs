// Front of a dam break on a dry bed against Martin & Moyce and Koshizuka & Oka.
import { holds, reference } from '../harness.mjs';
import { at, crossings, largest, mean, smallest } from '../signal.mjs';

const GRAVITY = 9.81, WIDTH = 1, END = 1.15;
const RELEASE = 1.44; // widths: where fronts are laid upon each other
const READING = 0.01; // of the front: two digitisations of one curve differ by as much and more
const SERIES = 3; // that make a spread; later only Martin & Moyce's two remain
const NAMES = ['Martin & Moyce, a = 1.125 in', 'Martin & Moyce, a = 2.25 in', 'Koshizuka & Oka', 'Koshizuka & Oka, other digitisation'];

function compare(simulate) {
  const data = reference('dambreak_fronts/fronts.csv');
  const [which, t, z] = ['series', 't_star', 'front'].map(data.column);
  const series = NAMES.map((label, k) => {
    const own = which.map((_, i) => i).filter((i) => which[i] === k + 1);
    return { label, x: own.map((i) => t[i]), y: own.map((i) => z[i]) };
  });
  const run = simulate('dambreak_front', { until: END });
  const time = run.time.map((s) => s * Math.sqrt(2 * GRAVITY / WIDTH));
  const front = run.column('front.run_up_m').map((x) => x / WIDTH);
  const there = (x, y) => crossings(x, y, RELEASE, true)[0];
  const shift = mean(series.map((s) => there(s.x, s.y))) - there(time, front);
  const late = time.map((s) => s + shift);
  const outside = { spread: 0, later: 0 };
  for (let s = there(late, front); s <= late.at(-1); s += 0.02) {
    const spread = series.map((m) => at(m.x, m.y, s)).filter(Number.isFinite);
    if (!spread.length) continue;
    const own = at(late, front, s), part = spread.length < SERIES ? 'later' : 'spread';
    outside[part] = Math.max(outside[part], (own - largest(spread)) / own, (smallest(spread) - own) / own);
  }
  const percent = (share) => `${(100 * share).toFixed(1)} %`;
  return {
    bars: [holds(`front outside the spread of at least ${SERIES} measurements, from ${RELEASE} widths on, let go ${shift.toFixed(2)} later`,
      percent(outside.spread), `at most ${percent(READING)} of it, as read`, outside.spread <= READING)],
    notes: [`In the experiments a gate takes its time to open, here water is free at once: fronts are laid upon each other at ${RELEASE} widths. ` +
      `The shift in t sqrt(2g/a) is ${(1000 * shift * Math.sqrt(0.0286 / 19.62)).toFixed(0)} ms for a = 1.125 in; without it the front leads by it at all times.`,
    `Later, where only Martin & Moyce's two columns remain, the front is up to ${percent(outside.later)} ahead of the faster: walls slip freely.`],
    plot: { panels: [{ x: 't sqrt(2g/a) [-]', y: 'front / a [-]', key: 'top left', xrange: [0, 5.5], yrange: [1, 8], curves: [
      { label: 'simulated, released later', x: late, y: front },
      { label: 'simulated', style: 'dashed', x: time, y: front },
      ...series.map((s, k) => ({ ...s, style: 'points', colour: ['#c4501b', '#8a6d00', '#2b8a3e', '#7b3fa0'][k] }))] }] },
  };
}

export const studies = [{
  name: 'dambreak_front',
  title: 'Front of a dam break on a dry bed',
  reference: 'Martin & Moyce 1952; Koshizuka & Oka 1996',
  compare,
}];
