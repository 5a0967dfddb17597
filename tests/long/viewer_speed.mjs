// What a viewer costs the solver: one server of the default case, windows of time without anybody and
// with one socket that acknowledges every picture in turn; the two neighbours are compared.
//   node viewer_speed.mjs PROGRAM SOURCE_DIR [PAIRS] [SECONDS]
// The clock of a shared machine wanders, so windows are short and many, and the median of the neighbours' ratios
// counts. A pair during which other programs took more than a twentieth of the machine is told and left out.
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { sleep, startServer } from '../server/client.mjs';
import { fact, finish } from './study.mjs';

const [program, source, pairs = '12', seconds = '5'] = process.argv.slice(2);
const WANTED = 0.85; // share of the bare speed that is left
const DISTURBED = 0.05; // of all cores' time, taken by others
const SETTLE_MS = 1000; // between windows
const TICK = 0.01; // of /proc [s]

const median = (values) => {
  const sorted = [...values].sort((a, b) => a - b);
  return (sorted[(sorted.length - 1) >> 1] + sorted[sorted.length >> 1]) / 2;
};

/// Processor seconds so far: of the machine's cores in all, of those in use by others than server and script.
function processor(server) {
  const fields = readFileSync('/proc/stat', 'utf8').split('\n')[0].trim().split(/\s+/).slice(1, 9).map(Number);
  const all = fields.reduce((sum, ticks) => sum + ticks, 0) * TICK;
  const idle = (fields[3] + fields[4]) * TICK;
  const words = readFileSync(`/proc/${server.child.pid}/stat`, 'utf8').replace(/^.*\) /, '').split(' ');
  const { user, system } = process.cpuUsage();
  return { all, others: all - idle - (Number(words[11]) + Number(words[12])) * TICK - (user + system) * 1e-6 };
}

/// The moment a new simulated time is told: the server copies it ten times a second.
async function mark(server) {
  const read = async () => (await (await server.get('/health')).json()).time_s;
  const first = await read();
  for (;;) {
    const time = await read();
    if (time !== first) return { time, wall: performance.now() / 1000, ...processor(server) };
    await sleep(5);
  }
}

/// speed: simulated seconds per second of wall time; others: what they took of the machine, 0..1.
async function window(server) {
  const begin = await mark(server);
  await sleep(1000 * Number(seconds));
  const end = await mark(server);
  const wall = end.wall - begin.wall;
  return { speed: (end.time - begin.time) / wall, wall, others: (end.others - begin.others) / (end.all - begin.all) };
}

const work = mkdtempSync(join(tmpdir(), 'fairlead-viewer-'));
const server = await startServer(program, work, join(source, 'cases/moored_ship.json'));
const kept = [];
await sleep(5000); // the caches and the clock of the processor
for (let tries = 0; kept.length < Number(pairs) && tries < 3 * Number(pairs); tries++) {
  const bare = await window(server);
  const client = await server.greet();
  await sleep(SETTLE_MS);
  const before = client.pictures.length;
  const watched = await window(server);
  const rate = (client.pictures.length - before) / watched.wall;
  client.close();
  await sleep(SETTLE_MS);
  const others = Math.max(bare.others, watched.others), ratio = watched.speed / bare.speed;
  if (others <= DISTURBED) kept.push({ bare: bare.speed, watched: watched.speed, ratio, rate });
  console.log(`bare ${bare.speed.toFixed(4)}, watched ${watched.speed.toFixed(4)} simulated s/s, ratio ${ratio.toFixed(3)}, ` +
    `${rate.toFixed(2)} pictures/s, others ${(100 * others).toFixed(0)} %${others > DISTURBED ? ': left out' : ''}`);
}
await server.stop();
rmSync(work, { recursive: true, force: true });
const middle = (key) => median(kept.map((pair) => pair[key]));
fact('undisturbed pairs of windows, at least 3', kept.length, kept.length >= 3);
if (kept.length >= 3) {
  console.log(`medians: bare ${middle('bare').toFixed(4)}, watched ${middle('watched').toFixed(4)} simulated s/s`);
  fact(`speed with one viewer over bare speed, at least ${WANTED}`, middle('ratio').toFixed(3), middle('ratio') >= WANTED);
  fact('pictures per second, at least 3', middle('rate').toFixed(2), middle('rate') >= 3);
}
finish();
