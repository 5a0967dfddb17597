// The same run with one and with two threads gives the same series.csv, byte for byte.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const [program, root] = process.argv.slice(2);
const out = mkdtempSync(join(tmpdir(), 'fairlead-threads-'));
try {
  const series = [1, 2].map((threads) => {
    const dir = join(out, String(threads));
    execFileSync(program, ['run', join(root, 'cases/moored_ship_draft.json'), '--until', '0.3', '--out', dir,
      '--threads', String(threads), '--quiet'], { stdio: 'inherit' });
    return readFileSync(join(dir, 'series.csv'));
  });
  const rows = series[0].toString().trim().split('\n').length;
  if (rows < 5) throw new Error(`only ${rows} rows in series.csv`);
  if (!series[0].equals(series[1])) throw new Error('series.csv differs between 1 and 2 threads');
  console.log(`${rows} rows, identical`);
} finally {
  rmSync(out, { recursive: true, force: true });
}
