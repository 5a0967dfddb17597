// A small WebSocket client (node 18 has none) and a server to talk to.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { randomBytes } from 'node:crypto';
import { mkdtempSync, readdirSync } from 'node:fs';
import { createConnection } from 'node:net';
import { join } from 'node:path';

export const sleep = (ms) => new Promise((done) => setTimeout(done, ms));

export class Client {
    constructor(port, { origin, host = `127.0.0.1:${port}`, protocol = 'fairlead', path = '/ws' } = {}) {
        this.messages = [];
        this.pictures = [];
        this.waiting = [];
        this.autoAck = true;
        this.buffer = Buffer.alloc(0);
        this.socket = createConnection(port, '127.0.0.1');
        this.socket.on('error', () => {});
        this.closed = new Promise((done) => this.socket.on('close', () => done(this.closeCode ?? 0)));
        const lines = [`GET ${path} HTTP/1.1`, `Host: ${host}`, 'Upgrade: websocket', 'Connection: Upgrade',
            `Sec-WebSocket-Key: ${randomBytes(16).toString('base64')}`, 'Sec-WebSocket-Version: 13'];
        if (origin) lines.push(`Origin: ${origin}`);
        if (protocol) lines.push(`Sec-WebSocket-Protocol: ${protocol}`);
        this.socket.write(`${lines.join('\r\n')}\r\n\r\n`);
        this.opened = new Promise((done) => {
            this.socket.on('close', () => done(false));
            this.onHead = (head) => done(head.startsWith('HTTP/1.1 101'));
        });
        this.socket.on('data', (bytes) => this.receive(bytes));
    }

    receive(bytes) {
        this.buffer = Buffer.concat([this.buffer, bytes]);
        if (!this.upgraded) {
            const end = this.buffer.indexOf('\r\n\r\n');
            if (end < 0) return;
            this.head = this.buffer.subarray(0, end).toString();
            this.buffer = this.buffer.subarray(end + 4);
            this.upgraded = true;
            this.onHead(this.head);
        }
        while (this.buffer.length >= 2) {
            let length = this.buffer[1] & 127;
            let at = 2;
            if (length === 126) length = this.buffer.length < 4 ? Infinity : this.buffer.readUInt16BE((at = 4) - 2);
            else if (length === 127) length = this.buffer.length < 10 ? Infinity : Number(this.buffer.readBigUInt64BE((at = 10) - 8));
            if (this.buffer.length < at + length) return;
            const first = this.buffer[0];
            const payload = this.buffer.subarray(at, at + length);
            this.buffer = this.buffer.subarray(at + length);
            this.frame(first & 15, (first & 128) !== 0, payload);
        }
    }

    frame(opcode, final, payload) {
        if (opcode === 8) {
            this.closeCode = payload.length >= 2 ? payload.readUInt16BE(0) : 1005;
            this.sendFrame(8, payload);
            this.socket.end();
        }
        else if (opcode === 9) this.sendFrame(10, payload);
        else if (opcode <= 2) {
            this.opcode = opcode || this.opcode;
            this.parts = opcode ? [payload] : [...this.parts, payload];
            if (final) this.message(this.opcode === 2, Buffer.concat(this.parts));
        }
    }

    message(binary, bytes) {
        if (binary) {
            assert.equal(bytes.toString('latin1', 0, 4), 'FLF1');
            const picture = {
                type: 'picture', kind: bytes.readUInt32LE(4), number: bytes.readUInt32LE(8),
                width: bytes.readUInt16LE(12), height: bytes.readUInt16LE(14), time: bytes.readDoubleLE(16),
                payload: bytes.subarray(32),
            };
            assert.equal(bytes.readUInt32LE(24), bytes.length - 32);
            this.pictures.push(picture);
            if (picture.kind === 0 && this.autoAck) this.send({ type: 'ack', frame: picture.number });
            this.deliver(picture);
        } else {
            const message = JSON.parse(bytes.toString('utf8'));
            this.messages.push(message);
            this.deliver(message);
        }
    }

    deliver(message) {
        this.waiting = this.waiting.filter(({ wanted, done }) => !wanted(message) || (done(message), false));
    }

    // The next message that `wanted` accepts.
    next(wanted, what = wanted.toString()) {
        const test = typeof wanted === 'string' ? (m) => m.type === wanted : wanted;
        return Promise.race([
            new Promise((done) => this.waiting.push({ wanted: test, done })),
            sleep(8000).then(() => { throw new Error(`no ${what} came`); }),
        ]);
    }

    sendFrame(opcode, payload, final = true) {
        const mask = randomBytes(4);
        const size = payload.length < 126 ? 2 : payload.length < 65536 ? 4 : 10;
        const head = Buffer.alloc(size);
        head[0] = (final ? 128 : 0) | opcode;
        head[1] = 128 | (size === 2 ? payload.length : size === 4 ? 126 : 127);
        if (size === 4) head.writeUInt16BE(payload.length, 2);
        if (size === 10) head.writeBigUInt64BE(BigInt(payload.length), 2);
        this.socket.write(Buffer.concat([head, mask, payload.map((byte, i) => byte ^ mask[i & 3])]));
    }

    sendText(text) { this.sendFrame(1, Buffer.from(text)); }
    send(message) { this.sendText(JSON.stringify(message)); }

    // Send a message with an id and wait for its answer.
    async ask(message) {
        const id = (Client.id = (Client.id ?? 0) + 1);
        const answer = this.next((m) => m.id === id && (m.type === 'accepted' || m.type === 'error'), `answer to ${message.type}`);
        this.send({ ...message, id });
        return answer;
    }

    async greet() {
        assert.equal(await this.opened, true, 'socket opens');
        const hello = this.next('hello');
        this.send({ type: 'hello', protocol: 1 });
        this.hello = await hello;
        return this;
    }

    rows() { return this.messages.filter((m) => m.type === 'series').flatMap((m) => m.rows); }
    close() { this.socket.destroy(); }
}

// Start `program serve CASE` on a free port with a data folder of its own below `work`.
export async function startServer(program, work, caseFile, ...words) {
    const data = mkdtempSync(join(work, 'data-'));
    const child = spawn(program, ['serve', caseFile, '--port', '0', '--data', data, ...words],
        { stdio: ['ignore', 'pipe', 'pipe'] });
    const server = { child, data, out: '', err: '' };
    server.ended = new Promise((done) => child.on('close', (code, signal) => {
        done(signal ?? code);
    }));
    child.stderr.on('data', (bytes) => (server.err += bytes));
    await new Promise((done, fail) => {
        child.stdout.on('data', (bytes) => {
            server.out += bytes;
            if (server.out.includes('pictures')) done();
        });
        server.ended.then((code) => fail(new Error(`server ended with ${code}: ${server.err}`)));
    });
    server.port = Number(/127\.0\.0\.1:(\d+)\//.exec(server.out)[1]);
    server.connect = (options) => new Client(server.port, options);
    server.greet = (options) => server.connect(options).greet();
    server.get = (path, options) => fetch(`http://127.0.0.1:${server.port}${path}`, options);
    server.stop = async () => {
        const begin = Date.now();
        child.kill('SIGINT');
        const code = await server.ended;
        assert.equal(code, 0, `clean end, not ${code}: ${server.err}`);
        return Date.now() - begin;
    };
    server.folder = (i = 0) => join(data, readdirSync(data).sort()[i]);
    return server;
}
