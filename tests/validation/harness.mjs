// What studies are made of: running a case, reading series and reference data, stating a bar.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

// Threads that wait must not spin where others work too.
const CALM = { OMP_WAIT_POLICY: 'passive', GOMP_SPINCOUNT: '10000' };

export const ROOT = fileURLToPath(new URL('../..', import.meta.url));

/// Columns of a comma-separated file by their heads. Lines that begin with # are left out; what is no number is NaN.
export function readTable(path) {
  const lines = readFileSync(path, 'utf8').split('\n').filter((line) => line.trim() && !line.startsWith('#'));
  const names = lines[0].trim().split(',');
  const rows = lines.slice(1).map((line) => line.split(',').map((word) => (word.trim() === '' ? NaN : Number(word))));
  return { names, column: (name) => {
    const index = names.indexOf(name);
    if (index < 0) throw new Error(`${path} has no column ${name}`);
    return rows.map((row) => row[index]);
  } };
}

/// A case of cases/validation, as it is written.
export const sceneOf = (name) => JSON.parse(readFileSync(join(ROOT, 'cases/validation', `${name}.json`), 'utf8'));

/// Reference data, a file of tests/data.
export const reference = (file) => readTable(join(ROOT, 'tests/data', file));

function readRun(folder) {
  const table = readTable(join(folder, 'series.csv'));
  const summary = JSON.parse(readFileSync(join(folder, 'summary.json'), 'utf8'));
  return { time: table.column('t_s'), names: table.names, column: table.column, summary };
}

/// A function simulate(NAME, { until, set }) that runs cases/validation/NAME.json and returns its time, its columns and
/// its summary; cost() tells what all its runs took together.
/// @param made  folder of one run that was made before and is read instead; undefined: none
export function simulator(program, made) {
  const runs = [];
  const simulate = (name, { until, set = [] }) => {
    const out = made ?? mkdtempSync(join(tmpdir(), 'fairlead-validation-'));
    const words = [join(ROOT, 'cases/validation', `${name}.json`), ...set.flatMap((change) => ['--set', change])];
    try {
      if (!made)
        execFileSync(program, ['run', ...words, '--until', String(until), '--out', out, '--quiet'],
          { stdio: ['ignore', 'inherit', 'inherit'], env: { ...CALM, ...process.env } });
      const run = readRun(out);
      const hash = made && /\((\w+)\)/.exec(execFileSync(program, ['explain', ...words], { encoding: 'utf8' }).split('\n')[0])[1];
      if (made && (run.summary.case_hash !== hash || run.summary.simulated_s < until))
        throw new Error(`${made} holds another run than ${name} of now until ${until} s`);
      runs.push(run.summary);
      return run;
    } finally {
      if (!made) rmSync(out, { recursive: true, force: true });
    }
  };
  simulate.cost = () => ({
    runs: runs.length,
    particles: Math.max(...runs.map((run) => run.particles)),
    spacing_m: Math.min(...runs.map((run) => run.spacing_m)),
    threads: runs[0].threads,
    steps: runs.reduce((sum, run) => sum + run.steps, 0),
    simulated_s: runs.reduce((sum, run) => sum + run.simulated_s, 0),
    seconds: runs.reduce((sum, run) => sum + run.wall_s, 0),
  });
  return simulate;
}

/// A figure that must not exceed a limit.
export function atMost(what, value, limit, unit = '') {
  const told = unit === '%' ? [100 * value, 100 * limit] : [value, limit];
  const space = unit ? ` ${unit}` : '';
  return { what, value: `${Number(told[0].toPrecision(3))}${space}`, limit: `at most ${Number(told[1].toPrecision(3))}${space}`,
    good: Math.abs(value) <= limit };
}

/// A figure that must reach a limit.
export function atLeast(what, value, limit, unit = '') {
  const bar = atMost(what, value, limit, unit);
  return { ...bar, limit: bar.limit.replace('at most', 'at least'), good: value >= limit };
}

/// Something that holds or does not.
export const holds = (what, value, limit, good) => ({ what, value: String(value), limit, good });
