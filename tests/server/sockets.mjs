// The server through its sockets.
//   node sockets.mjs PROGRAM
// PROGRAM is fairlead linked with the stand-ins for engine and renderer.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { createConnection } from 'node:net';
import { cpus, tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { Client, sleep, startServer } from './client.mjs';

const program = process.argv[2];
const here = dirname(fileURLToPath(import.meta.url));
const fakeCase = join(here, 'fake_case.json');
const work = mkdtempSync(join(tmpdir(), 'fairlead-sockets-'));
const page = join(work, 'page');

const running = new Set();
async function start(...words) {
    const started = await startServer(program, work, fakeCase, '--page', page, ...words);
    running.add(started.child);
    return started;
}

let server;
before(async () => {
    mkdirSync(page);
    writeFileSync(join(page, 'index.html'), '<!doctype html><title>page</title>');
    writeFileSync(join(page, 'app.mjs'), 'export {};');
    writeFileSync(join(work, 'secret.txt'), 'secret');
    server = await start();
});
after(async () => {
    if (server) assert.ok((await server.stop()) < 1500, 'ends within a second');
    for (const child of running) child.kill('SIGKILL');
    rmSync(work, { recursive: true, force: true });
    if (server) assert.equal(server.err, '');
});

// ---- facts --------------------------------------------------------------------------------------

test('files come with their type and with security headers', async () => {
    for (const [path, type] of [['/', 'text/html'], ['/app.mjs', 'text/javascript'], ['/health', 'application/json']]) {
        const answer = await server.get(path);
        assert.equal(answer.status, 200, path);
        assert.ok(answer.headers.get('content-type').startsWith(type), path);
        assert.equal(answer.headers.get('x-content-type-options'), 'nosniff');
        assert.equal(answer.headers.get('x-frame-options'), 'DENY');
        assert.match(answer.headers.get('content-security-policy'), /default-src 'self'.*frame-ancestors 'none'/);
        await answer.text();
    }
    assert.equal((await (await server.get('/health')).json()).status, 'ok');
});

test('nothing outside the page folder is served', async () => {
    assert.equal((await server.get('/nothing')).status, 404);
    for (const path of ['/../secret.txt', '/%2e%2e/secret.txt', '/..%2fsecret.txt', '/app.mjs/../../secret.txt']) {
        const client = createConnection(server.port, '127.0.0.1');
        client.write(`GET ${path} HTTP/1.1\r\nHost: 127.0.0.1:${server.port}\r\nConnection: close\r\n\r\n`);
        let text = '';
        for await (const bytes of client) text += bytes;
        assert.ok(!text.includes('secret\n') && !/\r\n\r\nsecret/.test(text), path);
    }
});

test('a body sent to the server does not hang it', async () => {
    await assert.rejects(server.get('/', { method: 'POST', body: 'x' }));
    assert.equal((await server.get('/health')).status, 200);
});

test('sockets of other origins are refused', async () => {
    const port = server.port;
    const cases = [
        [{ origin: `http://127.0.0.1:${port}` }, true],
        [{ origin: `http://localhost:${port}`, host: `localhost:${port}` }, true],
        [{}, true],
        [{ origin: 'http://evil.test' }, false],
        [{ origin: 'null' }, false],
        [{ origin: `http://127.0.0.1:${port + 1}` }, false],
        [{ origin: `http://evil.test:${port}`, host: `evil.test:${port}` }, false],
        [{ origin: `http://127.0.0.1:${port}`, protocol: '' }, false],
        [{ protocol: '' }, false],
        [{ origin: 'http://evil.test', protocol: '' }, false],
        [{ protocol: 'http' }, false],
        [{ protocol: 'other' }, false],
        [{ path: '/' }, false],
    ];
    for (const [options, opens] of cases) {
        const client = server.connect(options);
        assert.equal(await client.opened, opens, JSON.stringify(options));
        client.close();
    }
});

test('hello brings hello, status, series and pictures', async () => {
    const client = await server.greet();
    assert.deepEqual(client.hello.columns, ['t_s', 'ship.heave_m', 'bow_line.fairlead_tension_n', 'g1.elevation_m']);
    assert.equal(client.hello.protocol, 1);
    assert.equal(client.hello.particles, 1710);
    const effects = readFileSync(new URL('../../engine/effects.def', import.meta.url), 'utf8');
    assert.equal(client.hello.effects.length, effects.match(/^EFFECT\(/gm).length);
    assert.ok(Math.abs(client.hello.limits.heading_deg[1] - 180) < 1e-6);
    assert.equal(client.hello.current, null);
    const status = await client.next('status');
    assert.equal(status.state, 'running');
    const picture = await client.next('picture');
    assert.deepEqual([picture.kind, picture.width, picture.height], [0, 960, 540]);
    assert.equal(picture.payload.readUInt16BE(0), 0xffd8);
    await client.next((m) => m.type === 'status' && m.speed > 0 && m.frames_per_s > 0);
    assert.equal(client.rows()[0][0], 0);
    client.close();
});

test('an order for a line is accepted or refused with its id, and told in the status', async () => {
    const client = await server.greet();
    assert.deepEqual(client.hello.winches, [null]);
    assert.equal((await client.ask({ type: 'line', name: 'bow_line', length_m: 5.5 })).type, 'accepted');
    const refusal = await client.ask({ type: 'line', name: 'stern_line', cut: 'anchor' });
    assert.deepEqual([refusal.type, refusal.path], ['error', 'line.name']);
    while ((await client.next('status')).lines[0].asked_m !== 5.5);
    client.close();
});

test('before hello nothing but an error comes', async () => {
    const client = server.connect();
    await client.opened;
    client.send({ type: 'run', id: 1, action: 'pause' });
    assert.match((await client.next('error')).message, /hello/);
    client.send({ type: 'hello', protocol: 2 });
    assert.equal((await client.next('error')).path, 'hello.protocol');
    await sleep(400);
    assert.ok(client.messages.every((m) => m.type === 'error'));
    client.close();
});

test('a late client gets the whole history, each sample once and in order', async () => {
    const first = await server.greet();
    await sleep(600);
    const late = await server.greet();
    await sleep(600);
    for (const client of [first, late]) {
        const times = client.rows().map((row) => row[0]);
        assert.equal(times[0], 0);
        times.forEach((time, i) => assert.ok(Math.abs(time - 0.02 * i) < 0.0045, `sample ${i} at ${time}`));
        client.close();
    }
});

test('a wave is accepted, marked for everyone and journalled', async () => {
    const [one, two] = [await server.greet(), await server.greet()];
    const marker = two.next((m) => m.type === 'marker' && m.text.includes('height 0.21'));
    const answer = await one.ask({ type: 'wave', height_m: 0.21, heading_deg: 60 });
    assert.equal(answer.type, 'accepted');
    assert.ok(Math.abs((await marker).time_s - answer.time_s) < 1e-6);
    const status = await two.next((m) => m.type === 'status' && m.wave.asked.height_m === 0.21);
    assert.ok(Math.abs(status.wave.asked.heading_deg - 60) < 1e-9);
    const journal = readFileSync(join(server.folder(), 'journal.jsonl'), 'utf8').trim().split('\n').map((l) => JSON.parse(l));
    assert.equal(journal[0].event, 'start');
    const line = journal.find((l) => l.wave?.height_m === 0.21);
    assert.ok(Math.abs(line.time_s - answer.time_s) < 1e-6);
    one.close();
    two.close();
});

test('bad messages are answered with an error and change nothing', async () => {
    const client = await server.greet();
    const refused = await client.ask({ type: 'wave', height_m: 99 });
    assert.equal(refused.type, 'error');
    assert.equal(refused.path, 'wave.height_m');
    assert.match(refused.message, /0 to 0.5/);
    for (const text of ['nonsense', '{}', '[]', '{"type":"shout"}', '{"type":"view","width":1}', '{"type":"\\ud800"}']) {
        const error = client.next('error');
        client.sendText(text);
        assert.equal((await error).id, null, text);
    }
    client.sendFrame(1, Buffer.from('{"type":"vi'), false);
    const pieces = client.next('error');
    client.sendFrame(0, Buffer.from('ew"}'));
    assert.equal((await pieces).path, 'view');
    assert.equal((await client.ask({ type: 'wave', height_m: 0.3 })).type, 'accepted');
    client.close();
});

test('abuse closes the connection and hurts nobody else', async () => {
    const good = await server.greet();
    const binary = await server.greet();
    binary.sendFrame(2, Buffer.from([1, 2, 3]));
    assert.equal(await binary.closed, 1003);
    const large = await server.greet();
    large.sendText(`{"type":"view","x":"${'x'.repeat(70000)}"}`);
    assert.equal(await large.closed, 1009);
    const broken = await server.greet();
    broken.sendFrame(1, Buffer.from([0x22, 0xff, 0xfe, 0x22]));
    await broken.closed;
    const unmasked = await server.greet();
    unmasked.socket.write(Buffer.from([0x81, 2, 0x7b, 0x7d]));
    unmasked.socket.write(Buffer.alloc(200, 0xff));
    await Promise.race([unmasked.closed, sleep(500)]);
    unmasked.close();
    await good.next('status');
    good.close();
});

test('only one live picture is ever unacknowledged', async () => {
    const [client, eager] = [await server.greet(), await server.greet()];
    client.autoAck = false;
    const first = client.pictures.at(-1) ?? (await client.next('picture'));
    await sleep(300);
    const before = client.pictures.length;
    await sleep(700);
    assert.equal(client.pictures.length, before);
    client.send({ type: 'ack', frame: 123456 });
    await sleep(300);
    assert.equal(client.pictures.length, before, 'a wrong number gives no credit');
    client.send({ type: 'ack', frame: client.pictures.at(-1).number });
    const next = await client.next('picture');
    assert.ok(next.number > first.number && next.time > first.time);
    assert.ok(eager.pictures.length > client.pictures.length + 2, 'others are not held up');
    client.close();
    eager.close();
});

test('cheap pictures come quickly, and no more than thirty a second', async () => {
    const client = await server.greet();
    await client.next('picture');
    const before = client.pictures.length;
    await sleep(2000);
    const rate = (client.pictures.length - before) / 2;
    assert.ok(rate >= 3 && rate <= 31, `${rate} pictures per second`);
    client.close();
});

test('dear pictures come once a second at least, and freely while the solver rests', async () => {
    const cost = 0.2, share = 0.075; // PACE_SHARE of server/pace.h
    process.env.FAKE_RENDER_MS = String(1000 * cost);
    const dear = await start();
    delete process.env.FAKE_RENDER_MS;
    const client = await dear.greet();
    await client.next('picture');
    await client.next('picture');
    const before = client.pictures.length;
    await sleep(4000);
    const running = (client.pictures.length - before) / 4;
    const affordable = Math.max(1, (share * cpus().length) / cost);
    assert.ok(running >= 0.7 && running <= 1.3 * affordable, `${running} pictures per second, ${affordable} affordable`);
    await client.ask({ type: 'run', action: 'pause' });
    let turned = 0;
    for (const end = Date.now() + 2000; Date.now() < end; turned++) {
        const picture = client.next('picture');
        client.send({ type: 'camera', azimuth_deg: turned });
        await picture;
    }
    assert.ok(turned / 2 >= 2, `${turned / 2} pictures per second while it rests`);
    client.close();
    await dear.stop();
});

test('without a watcher nothing is drawn', async () => {
    await sleep(700);
    const client = await server.greet();
    await client.next('picture');
    client.close();
    await sleep(500); // until the server has seen it leave
    const brief = await server.greet();
    const first = (await brief.next('picture')).number;
    brief.close();
    const drawn = brief.pictures.at(-1).number;
    await sleep(1500);
    const again = await server.greet();
    const { number } = await again.next('picture');
    again.close();
    assert.ok(number <= drawn + 2, `${number - drawn} more after ${first}`);
});

test('view and camera are shared, and told to the others only', async () => {
    const [one, two] = [await server.greet(), await server.greet()];
    const camera = two.next('camera');
    one.send({ type: 'camera', azimuth_deg: 33, distance_m: 7.5 });
    const told = await camera;
    assert.ok(Math.abs(told.azimuth_deg - 33) < 1e-9 && told.distance_m === 7.5);
    const view = two.next('view');
    one.send({ type: 'view', width: 640, height: 360, field: 'speed' });
    assert.deepEqual({ ...(await view) }, { type: 'view', width: 640, height: 360, water: 'surface', field: 'speed', dark: false });
    await two.next((m) => m.type === 'picture' && m.width === 640);
    assert.ok(!one.messages.some((m) => m.type === 'camera' || m.type === 'view'));
    one.send({ type: 'view', width: 960, height: 540, field: 'none' });
    one.close();
    two.close();
});

test('a still comes as PNG in the size asked for, to whom asked', async () => {
    const [one, two] = [await server.greet(), await server.greet()];
    const status = await one.next('status');
    const still = one.next((m) => m.type === 'picture' && m.kind === 1);
    one.send({ type: 'snapshot', id: 77, width: 321, height: 200 });
    const picture = await still;
    assert.deepEqual([picture.number, picture.width, picture.height], [77, 321, 200]);
    assert.ok(picture.time >= status.time_s);
    assert.equal(picture.payload.toString('latin1', 1, 4), 'PNG');
    assert.deepEqual([picture.payload.readUInt32BE(16), picture.payload.readUInt32BE(20)], [321, 200]);
    assert.ok(two.pictures.every((p) => p.kind === 0));
    one.close();
    two.close();
});

test('pause stops time, keeps the camera alive, and start goes on', async () => {
    const client = await server.greet();
    assert.equal((await client.ask({ type: 'run', action: 'pause' })).type, 'accepted');
    const still = await client.next((m) => m.type === 'status' && m.state === 'paused');
    await sleep(500);
    const later = await client.next('status');
    assert.equal(later.time_s, still.time_s);
    assert.equal(later.speed, 0);
    const last = client.pictures.at(-1);
    assert.ok(Math.abs(last.time - still.time_s) < 1e-9, 'the last picture shows the moment of the pause');
    const turned = client.next('picture');
    client.send({ type: 'camera', azimuth_deg: 80 });
    assert.equal((await turned).time, last.time);
    await client.ask({ type: 'run', action: 'start' });
    await client.next((m) => m.type === 'status' && m.time_s > still.time_s);
    client.close();
});

test('reset begins time, series and folder anew for everyone', async () => {
    const [one, two] = [await server.greet(), await server.greet()];
    await sleep(300);
    assert.equal((await one.ask({ type: 'run', action: 'reset' })).type, 'accepted');
    await sleep(600);
    two.messages.splice(0, two.messages.findIndex((m) => m.type === 'reset'));
    assert.equal(two.messages[0].type, 'reset');
    assert.ok(two.messages.some((m) => m.type === 'marker' && m.text === 'reset'));
    const times = two.rows().map((row) => row[0]);
    assert.equal(times[0], 0);
    times.forEach((time, i) => assert.ok(Math.abs(time - 0.02 * i) < 0.0045));
    assert.equal(readdirSync(server.data).length, 2);
    one.close();
    two.close();
});

test('a client that stops reading harms nobody and misses no sample afterwards', async () => {
    const [slow, quick] = [await server.greet(), await server.greet()];
    slow.socket.pause();
    const before = quick.pictures.length;
    await sleep(1500);
    assert.ok(quick.pictures.length > before + 3);
    slow.socket.resume();
    await sleep(500);
    const times = slow.rows().map((row) => row[0]);
    times.forEach((time, i) => assert.ok(i === 0 || time > times[i - 1]));
    assert.ok(times.every((time, i) => Math.abs(time - 0.02 * i) < 0.0045));
    slow.close();
    quick.close();
});

test('clients that come and go in a hurry leave nothing behind', async () => {
    for (let i = 0; i < 60; i++) {
        const client = server.connect();
        if (i % 3) await client.opened;
        if (i % 3 > 1) client.send({ type: 'hello', protocol: 1 });
        client.close();
    }
    const crowd = [];
    for (let i = 0; i < 40; i++) crowd.push(server.connect());
    await Promise.all(crowd.map((client) => client.opened));
    await sleep(200);
    crowd.forEach((client) => client.close());
    const client = await server.greet();
    await client.next((m) => m.type === 'status' && m.clients === 1);
    client.close();
});

test('sick physics is told, the server goes on and can be reset', async () => {
    const sick = await start('--set', 'fail_at_s=0.6', '--set', 'recover_at_s=0.2');
    const client = await sick.greet();
    const status = await client.next((m) => m.type === 'status' && m.state === 'failed');
    assert.equal(status.health.status, 'failed');
    assert.match(status.health.message, /not a number/);
    assert.ok(client.messages.some((m) => m.type === 'marker' && m.text.startsWith('rolled back')));
    assert.equal((await client.ask({ type: 'run', action: 'start' })).type, 'error');
    assert.equal((await client.ask({ type: 'wave', height_m: 0.2 })).type, 'error');
    assert.equal((await client.ask({ type: 'run', action: 'reset' })).type, 'accepted');
    await client.next((m) => m.type === 'status' && m.state === 'running' && m.time_s < 0.6);
    await client.next((m) => m.type === 'status' && m.state === 'failed');
    client.close();
    await sick.stop();
    const journal = readFileSync(join(sick.folder(), 'journal.jsonl'), 'utf8');
    assert.match(journal, /"event":"health".*not a number/);
});

test('a taken port is one clear line', async () => {
    const child = spawn(program, ['serve', fakeCase, '--port', String(server.port), '--data', join(work, 'never')]);
    let err = '';
    child.stderr.on('data', (bytes) => (err += bytes));
    const code = await new Promise((done) => child.on('close', done));
    assert.equal(code, 2);
    assert.match(err, /^fairlead: port \d+ at 127\.0\.0\.1 is taken.*\n$/);
});

test('the live series equals a replay of its journal', async () => {
    const live = await start('--set', 'step_ms=1');
    const client = await live.greet();
    for (const change of [{ height_m: 0.123 }, { heading_deg: 47.3 }, { period_s: 1.77, heading_deg: -12.1 }]) {
        assert.equal((await client.ask({ type: 'wave', ...change })).type, 'accepted');
        await sleep(200);
    }
    client.close();
    await live.stop();
    const out = join(work, 'replay');
    const series = readFileSync(join(live.folder(), 'series.csv'), 'utf8');
    const child = spawn(program, ['run', fakeCase, '--until', '0.9', '--out', out, '--quiet', '--set', 'step_ms=0',
        '--commands', join(live.folder(), 'journal.jsonl')], { stdio: 'inherit' });
    assert.equal(await new Promise((done) => child.on('close', done)), 0);
    const replay = readFileSync(join(out, 'series.csv'), 'utf8');
    const shorter = Math.min(series.length, replay.length);
    assert.ok(replay.split('\n').length > 30);
    assert.equal(series.slice(0, shorter), replay.slice(0, shorter));
});
