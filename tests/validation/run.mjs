// Published cases against what others measured or computed: runs cases/validation/*.json, compares, and writes the table
// and plots of docs/validation.md.
//   node tests/validation/run.mjs [--program FILE] [--check] [--list] [NAME…]
//   node tests/validation/run.mjs --made FOLDER NAME       compare what `fairlead run … --out FOLDER` has made
// Without names every study runs. --check only compares (ctest), nothing is written. Exit status 1: a bar was missed.
// A study is an entry of `studies` in a file of studies/: { name, title, reference, compare(simulate) }; see harness.mjs.
import { existsSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { ROOT, simulator } from './harness.mjs';
import { draw, gnuplotVersion } from './plot.mjs';
import { record, writePage } from './report.mjs';

const FOLDER = fileURLToPath(new URL('studies', import.meta.url));

function options(words) {
  const asked = { program: join(ROOT, 'build/fairlead'), check: false, list: false, names: [] };
  while (words.length) {
    const word = words.shift();
    if (word === '--program') asked.program = words.shift();
    else if (word === '--made') asked.made = words.shift();
    else if (word === '--check') asked.check = true;
    else if (word === '--list') asked.list = true;
    else asked.names.push(word);
  }
  return asked;
}

async function allStudies() {
  const files = readdirSync(FOLDER).filter((file) => file.endsWith('.mjs')).sort();
  const modules = await Promise.all(files.map((file) => import(join(FOLDER, file))));
  return modules.flatMap((module) => module.studies);
}

/// @return whether every bar was met
function runStudy(study, asked) {
  console.log(`${study.name}: ${study.title}`);
  const simulate = simulator(asked.program, asked.made);
  const result = study.compare(simulate);
  for (const bar of result.bars) console.log(`  ${bar.good ? 'ok  ' : 'FAIL'} ${bar.what}: ${bar.value} (${bar.limit})`);
  for (const note of result.notes ?? []) console.log(`       ${note}`);
  if (!asked.check) {
    const plotted = result.plot && gnuplotVersion() !== null;
    if (plotted) draw(study.name, result.plot);
    record(study, result, simulate.cost());
  }
  return result.bars.every((bar) => bar.good);
}

const asked = options(process.argv.slice(2));
const studies = await allStudies();
const unknown = asked.names.filter((name) => !studies.some((study) => study.name === name));
if (unknown.length) {
  console.error(`no study ${unknown.join(', ')}; there are ${studies.map((study) => study.name).join(', ')}`);
  process.exit(2);
}
const chosen = studies.filter((study) => !asked.names.length || asked.names.includes(study.name));
if (asked.list) {
  for (const study of chosen) console.log(`${study.name}: ${study.title}`);
  process.exit(0);
}
if (!existsSync(asked.program)) {
  console.error(`${asked.program}: not built; ./fairlead build`);
  process.exit(2);
}
if (!asked.check && gnuplotVersion() === null) console.log('note: without gnuplot (package gnuplot-nox) no plots are drawn');
const missed = chosen.filter((study) => !runStudy(study, asked)).map((study) => study.name);
if (!asked.check) writePage(studies);
console.log(missed.length ? `missed: ${missed.join(', ')}` : `all bars met: ${chosen.length}`);
process.exit(missed.length ? 1 : 0);
