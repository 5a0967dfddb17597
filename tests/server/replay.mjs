// A live session of the real engine, steered from a page, and a headless run that replays its journal
// give the same series.csv, byte for byte.
//   node replay.mjs PROGRAM
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { sleep, startServer } from './client.mjs';

const program = process.argv[2];
const wave = join(dirname(fileURLToPath(import.meta.url)), '../../cases/moored_ship_draft.json');
const set = ['--set', 'fluid.spacing_m=0.2', '--set', 'outputs.series_interval_s=0.01'];

test('a live session is repeated headless, bit by bit', async () => {
    const work = mkdtempSync(join(tmpdir(), 'fairlead-replay-'));
    try {
        const server = await startServer(program, work, wave, ...set);
        const client = await server.greet();
        for (const change of [{ height_m: 0.137 }, { heading_deg: 147.3 }, { period_s: 1.77, heading_deg: -163.9 }]) {
            const answer = await client.ask({ type: 'wave', ...change });
            assert.equal(answer.type, 'accepted', answer.message);
            await sleep(700);
        }
        for (const change of [{ length_m: 5.61 }, { cut: 'middle' }]) {
            const answer = await client.ask({ type: 'line', name: 'bow_line', ...change });
            assert.equal(answer.type, 'accepted', answer.message);
            await sleep(700);
        }
        const until = client.rows().at(-1)[0];
        client.close();
        await server.stop();
        const out = join(work, 'run');
        execFileSync(program, ['run', wave, ...set, '--until', String(until), '--out', out, '--threads', '1', '--quiet',
            '--commands', join(server.folder(), 'journal.jsonl')], { stdio: 'inherit' });
        const live = readFileSync(join(server.folder(), 'series.csv'), 'utf8');
        const replay = readFileSync(join(out, 'series.csv'), 'utf8');
        const journal = readFileSync(join(out, 'journal.jsonl'), 'utf8').trim().split('\n');
        assert.equal(journal.filter((line) => line.includes('"command"')).length, 5);
        assert.equal(journal.filter((line) => line.includes('"break"')).length, 1);
        assert.ok(replay.split('\n').length > 10, 'some samples');
        assert.equal(live.slice(0, replay.length), replay);
    } finally {
        rmSync(work, { recursive: true, force: true });
    }
});
