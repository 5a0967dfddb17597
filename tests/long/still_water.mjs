// Ten seconds of still water around the moored ship: it rests at its draft and everything slows down.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { fact, finish, runCase } from './study.mjs';

const [program, root] = process.argv.slice(2);
const file = join(root, 'cases/still_water.json');
const spacing = JSON.parse(readFileSync(file, 'utf8')).fluid.spacing_m;
const { column, rows, summary } = runCase(program, file, 10);
const time = column('t_s');
fact('every value is a number', rows.length, rows.every((row) => row.every(Number.isFinite)));
fact('health', summary.health.status, summary.health.status === 'good');

const mean = (values, from, to) => {
  const inside = values.filter((_, i) => time[i] >= from && time[i] < to);
  return inside.reduce((sum, v) => sum + v, 0) / inside.length;
};
const heave = column('ship.heave_m');
const offset = mean(heave, 6, 10);
fact('mean heave off the hydrostatic draft over spacing', (offset / spacing).toFixed(3), Math.abs(offset) < 0.5 * spacing);

// speeds: rms of the rate of each motion, early against late
const rate = (values, from, to) => {
  const steps = values.map((v, i) => (i ? (v - values[i - 1]) / (time[i] - time[i - 1]) : 0));
  return Math.sqrt(mean(steps.map((s) => s * s), from, to));
};
for (const name of ['heave_m', 'pitch_deg']) {
  const early = rate(column(`ship.${name}`), 0.5, 4);
  const late = rate(column(`ship.${name}`), 7, 10);
  fact(`rms rate of ${name}, early and late`, `${early.toExponential(2)} ${late.toExponential(2)}`, late < early);
}
finish();
