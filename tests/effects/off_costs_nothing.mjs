// Steps of still water with every effect switched off take as long as in a build that knows no
// effects: the ratio of the fastest steps of two programs that take turns is 1.00 +- 0.02.
//   node off_costs_nothing.mjs STEP_TIMER SOURCES
import { execFileSync, spawn } from 'node:child_process';
import { join } from 'node:path';
import { createInterface } from 'node:readline';

const ROUNDS = 40, MOST = 200, STEPS = 10, WITHIN = 0.02;
const [off, sources] = process.argv.slice(2);
const tree = join(sources, 'build', 'without_effects');
const quiet = { stdio: ['ignore', 'ignore', 'inherit'] };
execFileSync('cmake', ['-S', sources, '-B', tree, '-G', 'Ninja', '-DFAIRLEAD_WITHOUT_EFFECTS=ON'], quiet);
execFileSync('cmake', ['--build', tree, '--target', 'step_timer'], quiet);

class Timer {
    constructor(program) {
        this.child = spawn(program, { stdio: ['pipe', 'pipe', 'inherit'] });
        this.lines = createInterface({ input: this.child.stdout })[Symbol.asyncIterator]();
        this.fastest = Infinity;
        this.rounds = [];
    }
    async round(steps) {
        this.child.stdin.write(`${steps}\n`);
        const { value, done } = await this.lines.next();
        if (done) throw new Error(`the timer ended with ${this.child.exitCode}`);
        this.rounds.push(Number(value));
        this.fastest = Math.min(this.fastest, Number(value));
    }
}

const timers = [new Timer(off), new Timer(join(tree, 'tests', 'effects', 'step_timer'))];
for (const timer of timers) await timer.round(100);
for (const timer of timers) { timer.fastest = Infinity; timer.rounds = []; }
// A busy machine only ever makes a step longer: the fastest of more steps is nearer to the truth.
const near = () => Math.abs(timers[0].fastest / timers[1].fastest - 1) <= WITHIN;
for (let i = 0; i < ROUNDS || (i < MOST && !near()); i++)
    for (const timer of i % 2 ? timers : [timers[1], timers[0]]) await timer.round(STEPS);
for (const timer of timers) timer.child.stdin.end();
const [switched, out] = timers.map((timer) => timer.fastest);
const median = (values) => [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)];
const ratio = switched / out;
console.log(`${timers[0].rounds.length} rounds of ${STEPS} steps each`);
console.log(`fastest step: switched off ${(switched * 1e3).toFixed(4)} ms, not built ${(out * 1e3).toFixed(4)} ms, ratio ${ratio.toFixed(4)}`);
console.log(`median of rounds' fastest: ratio ${(median(timers[0].rounds) / median(timers[1].rounds)).toFixed(4)}`);
if (!near()) {
    console.log(`not within 1.00 +- ${WITHIN}`);
    process.exit(1);
}
