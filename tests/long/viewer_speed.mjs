// What a viewer costs the solver: one server of the default case, windows of time without anybody and
// with one socket that acknowledges every picture in turn; the two neighbours are compared.
//   node viewer_speed.mjs PROGRAM SOURCE_DIR [PAIRS] [SECONDS]
// The clock of a shared machine wanders: only neighbours are compared, and the median of their ratios counts.
import { mkdtempSync, rmSync } from 'node:fs';
import { loadavg, tmpdir } from 'node:os';
import { join } from 'node:path';
import { sleep, startServer } from '../server/client.mjs';
import { fact, finish } from './study.mjs';

const [program, source, pairs = '4', seconds = '20'] = process.argv.slice(2);
const WANTED = 0.85; // share of the bare speed that is left
const SETTLE_MS = 1000; // between windows

const median = (values) => {
  const sorted = [...values].sort((a, b) => a - b);
  return (sorted[(sorted.length - 1) >> 1] + sorted[sorted.length >> 1]) / 2;
};

/// The moment a new simulated time is told: the server copies it ten times a second.
async function mark(server) {
  const read = async () => (await (await server.get('/health')).json()).time_s;
  const first = await read();
  for (;;) {
    const time = await read();
    if (time !== first) return { time, wall: performance.now() / 1000 };
    await sleep(5);
  }
}

/// Simulated seconds per second of wall time.
async function window(server) {
  const begin = await mark(server);
  await sleep(1000 * Number(seconds));
  const end = await mark(server);
  const wall = end.wall - begin.wall;
  return { speed: (end.time - begin.time) / wall, wall };
}

const work = mkdtempSync(join(tmpdir(), 'fairlead-viewer-'));
const server = await startServer(program, work, join(source, 'cases/moored_ship.json'), '--threads', '2');
const bare = [], watched = [], rates = [];
await sleep(5000); // the caches and the clock of the processor
for (let pair = 0; pair < Number(pairs); pair++) {
  bare.push((await window(server)).speed);
  const client = await server.greet();
  await sleep(SETTLE_MS);
  const before = client.pictures.length;
  const { speed, wall } = await window(server);
  watched.push(speed);
  rates.push((client.pictures.length - before) / wall);
  client.close();
  await sleep(SETTLE_MS);
  console.log(`pair ${pair + 1}: bare ${bare[pair].toFixed(4)}, watched ${speed.toFixed(4)} simulated s/s, ` +
    `ratio ${(speed / bare[pair]).toFixed(3)}, ${rates[pair].toFixed(2)} pictures/s, load ${loadavg()[0].toFixed(2)}`);
}
await server.stop();
rmSync(work, { recursive: true, force: true });
// a watched window lies between two bare ones: the drift of the clock falls out
const ratios = watched.map((speed, i) => speed / (i + 1 < bare.length ? (bare[i] + bare[i + 1]) / 2 : bare[i]));
console.log(`medians: bare ${median(bare).toFixed(4)}, watched ${median(watched).toFixed(4)} simulated s/s`);
fact(`speed with one viewer over bare speed, at least ${WANTED}`, median(ratios).toFixed(3), median(ratios) >= WANTED);
fact('pictures per second, at least 1', median(rates).toFixed(2), median(rates) >= 1);
finish();
