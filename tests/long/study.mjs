// Running a case headless and reading what it wrote; facts are checked and printed with their figures.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

export function runCase(program, caseFile, until, extra = []) {
  const out = mkdtempSync(join(tmpdir(), 'fairlead-long-'));
  console.log(`${caseFile} until ${until} s → ${out}`);
  execFileSync(program, ['run', caseFile, '--until', String(until), '--out', out, ...extra], { stdio: 'inherit' });
  const [head, ...lines] = readFileSync(join(out, 'series.csv'), 'utf8').trim().split('\n');
  const names = head.split(',');
  const rows = lines.map((line) => line.split(',').map(Number));
  const column = (name) => {
    const index = names.indexOf(name);
    if (index < 0) throw new Error(`series.csv has no column ${name}`);
    return rows.map((row) => row[index]);
  };
  return { column, rows, summary: JSON.parse(readFileSync(join(out, 'summary.json'), 'utf8')) };
}

let failures = 0;
export function fact(text, value, good) {
  console.log(`${good ? 'ok  ' : 'FAIL'} ${text}: ${value}`);
  if (!good) failures++;
}
export function finish() {
  process.exit(failures ? 1 : 0);
}

/// Mean height of the waves between up-crossings of the mean, in [from, to).
export function waveHeight(time, elevation, from, to) {
  const inside = time.map((t, i) => i).filter((i) => time[i] >= from && time[i] < to);
  const mean = inside.reduce((sum, i) => sum + elevation[i], 0) / inside.length;
  const crossings = inside.filter((i) => i > 0 && elevation[i - 1] < mean && elevation[i] >= mean);
  const heights = crossings.slice(1).map((end, k) => {
    const wave = elevation.slice(crossings[k], end);
    return Math.max(...wave) - Math.min(...wave);
  });
  return heights.reduce((sum, h) => sum + h, 0) / heights.length;
}
