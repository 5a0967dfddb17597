// Keeps the figures of the last run of each study (results.json) and writes them into docs/validation.md, below the line
// that says so; the text above it is written by hand.
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { cpus } from 'node:os';
import { join } from 'node:path';
import { ROOT } from './harness.mjs';
import { IMAGES } from './plot.mjs';

const RESULTS = join(ROOT, 'tests/validation/results.json');
const PAGE = join(ROOT, 'docs/validation.md');
const MARK = '<!-- written by tests/validation/run.mjs: everything below -->';

const read = () => (existsSync(RESULTS) ? JSON.parse(readFileSync(RESULTS, 'utf8')) : {});

function machine() {
  const model = cpus()[0].model.replace(/\(R\)|\(TM\)/g, '').replace(/\s+/g, ' ').trim();
  return `${cpus().length} x ${model}`;
}

export function record(study, result, cost) {
  const results = read();
  results[study.name] = { bars: result.bars, notes: result.notes ?? [],
    cost: { ...cost, seconds: Math.round(cost.seconds * 10) / 10, simulated_s: Math.round(cost.simulated_s * 100) / 100,
      machine: machine(), date: new Date().toISOString().slice(0, 10) } };
  const ordered = Object.fromEntries(Object.keys(results).sort().map((name) => [name, results[name]]));
  writeFileSync(RESULTS, `${JSON.stringify(ordered, null, 1)}\n`);
}

const verdict = (result) => (result.bars.every((bar) => bar.good) ? 'met' : '**missed**');

function tableRow(study, result) {
  const { cost } = result;
  const bars = result.bars.map((bar) => `${bar.what} ${bar.good ? bar.value : `**${bar.value}**`} (${bar.limit})`).join('; ');
  const words = [`[${study.name}](#${study.name})`, study.reference, bars, verdict(result),
    `${cost.particles.toLocaleString('en')} particles, ${cost.seconds} s`];
  return `| ${words.join(' | ')} |`;
}

function section(study, result) {
  const { cost } = result;
  const picture = existsSync(join(IMAGES, `${study.name}.png`)) ? `\n![${study.title}](images/validation/${study.name}.png)\n` : '';
  const notes = [...(study.notes ?? []), ...result.notes].map((note) => `* ${note}\n`).join('');
  const runs = cost.runs > 1 ? `${cost.runs} runs, ` : '';
  return `### ${study.name}\n${study.title}. Reference: ${study.reference}.\n${picture}\n${notes}` +
    `* ${runs}spacing ${cost.spacing_m} m, ${cost.particles.toLocaleString('en')} particles with dummies, ${cost.steps.toLocaleString('en')} steps for ` +
    `${cost.simulated_s} s: ${cost.seconds} s of wall time on ${cost.threads} threads (${cost.machine}, ${cost.date}).\n`;
}

export function writePage(studies) {
  const results = read();
  const done = studies.filter((study) => results[study.name]);
  const head = readFileSync(PAGE, 'utf8').split(MARK)[0];
  const table = ['| case | reference | figures (bar) | | cost |', '|---|---|---|---|---|',
    ...done.map((study) => tableRow(study, results[study.name]))].join('\n');
  const sections = done.map((study) => section(study, results[study.name])).join('\n');
  writeFileSync(PAGE, `${head}${MARK}\n\n${table}\n\n${sections}`);
}
