// A minute of a moored body, coupled with its lines: node moorings.mjs PROGRAM ROOT CASE
import { join } from 'node:path';
import { fact, finish, runCase } from './study.mjs';

const [program, root, name] = process.argv.slice(2);
const { column, rows, summary } = runCase(program, join(root, `cases/${name}.json`), 60);
fact(`${name}: every value is a number`, rows.length, rows.every((row) => row.every(Number.isFinite)));
fact(`${name}: health`, summary.health.status, summary.health.status === 'good');
for (const line of summary.lines) {
  const tension = column(`${line.name}.fairlead_tension_n`);
  fact(`${name}, ${line.name}: pulls or hangs, never pushes, N at least`, Math.min(...tension), Math.min(...tension) >= 0);
  console.log(`     at rest ${line.tension_at_rest_n.toFixed(3)} N, largest ${line.largest_tension_n.toFixed(3)} N, snaps ${line.snaps}`);
}
for (const body of summary.lines_exchange.bodies)
  fact(`${name}, ${body.name}: exchanges with its lines within bounds, work off by`, body.work_error, body.within_bounds);
const share = summary.effects.find((effect) => effect.name === 'mooring_lines').share;
fact(`${name}: lines' share of a step below 2 %`, share, share < 0.02);
finish();
