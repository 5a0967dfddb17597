// Thirty seconds of the default case, then thirty more after a turn of the sea by 60 degrees.
import { mkdtempSync, readFileSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fact, finish, runCase, waveHeight } from './study.mjs';

const [program, root] = process.argv.slice(2);
const file = join(root, 'cases/moored_ship.json');
const scene = JSON.parse(readFileSync(file, 'utf8'));
const { height_m: height, period_s: period, heading_deg: heading } = scene.waves;
const commands = join(mkdtempSync(join(tmpdir(), 'fairlead-commands-')), 'commands.jsonl');
const wave = { height_m: height, period_s: period, heading_deg: heading + 60 };
writeFileSync(commands, JSON.stringify({ time_s: 30, event: 'command', wave }) + '\n');

const { column, rows, summary } = runCase(program, file, 60, ['--commands', commands]);
const time = column('t_s');
fact('every value is a number', rows.length, rows.every((row) => row.every(Number.isFinite)));
fact('health', summary.health.status, summary.health.status === 'good');
fact('lost particles', summary.health.lost_particles, summary.health.lost_particles === 0);
fact('largest density error', summary.largest_density_error, summary.largest_density_error < 0.015);
for (const angle of ['roll', 'pitch']) {
  const worst = Math.max(...column(`ship.${angle}_deg`).map(Math.abs));
  fact(`largest ${angle} [deg]`, worst, worst < 45);
}
const tension = column('bow_line.fairlead_tension_n');
fact('the line pulls in every sample, N at least', Math.min(...tension), Math.min(...tension) >= 0 && Math.max(...tension.slice(-50)) > 1);
for (const gauge of ['g1', 'g2'])
  for (const [from, to] of [[5, 30], [40, 60]]) {
    const ratio = waveHeight(time, column(`${gauge}.elevation_m`), from, to) / height;
    console.log(`     ${gauge} height over asked, ${from} to ${to} s: ${ratio.toFixed(4)}`);
  }
const far = waveHeight(time, column('g1.elevation_m'), 5, 30) / height;
fact('height away from the ship within 8 %', far.toFixed(4), Math.abs(far - 1) < 0.08);
console.log(`     simulated seconds per second: ${(summary.simulated_s / summary.wall_s).toFixed(3)}`);
finish();
