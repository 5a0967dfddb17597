import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";
import { Session } from "./session.ts";

/** The browser's socket, driven by hand. */
class FakeSocket {
  static readonly OPEN = 1;
  static made: FakeSocket[] = [];
  readyState = 0;
  sent: Record<string, unknown>[] = [];
  onopen: (() => void) | null = null;
  onclose: (() => void) | null = null;
  onmessage: ((event: { data: unknown }) => void) | null = null;
  constructor() {
    FakeSocket.made.push(this);
  }
  send(json: string) {
    this.sent.push(JSON.parse(json));
  }
  close() {
    this.readyState = 3;
  }
  open() {
    this.readyState = FakeSocket.OPEN;
    this.onopen?.();
  }
  say(message: object) {
    this.onmessage?.({ data: JSON.stringify(message) });
  }
  break() {
    this.readyState = 3;
    this.onclose?.();
  }
  last(type: string) {
    return this.sent.filter((message) => message["type"] === type).at(-1);
  }
}

const CAMERA = { azimuth_deg: 10, elevation_deg: 20, distance_m: 5, target_m: [0, 0, 0] };
const HELLO = {
  type: "hello", protocol: 1, version: "0", case: { name: "c", title: "C", hash: "1" }, backend: "cpu", threads: 1,
  renderer: "r", particles: 1, spacing_m: 1, columns: ["t_s", "a.heave_m"], bodies: ["a"], lines: ["l"], gauges: [], winches: [null],
  limits: { height_m: [0, 1], period_s: [1, 2], heading_deg: [0, 360] }, current: null, camera: CAMERA,
  view: { width: 960, height: 540, water: "particles", field: "none", dark: false }, warnings: [], effects: [],
};
const SEA = { height_m: 0.2, period_s: 1.5, heading_deg: 0 };
const status = (asked: object) => ({
  type: "status", time_s: 1, state: "running", speed: 1, step: 1, time_step_s: 1, particle_steps_per_s: 1,
  density_error: 0, frames_per_s: 1, clients: 1, health: { status: "good", message: "" },
  wave: { asked, now: SEA, changing: false }, lines: [], shares: {},
});

let session: Session;
let socket: FakeSocket;

beforeEach(() => {
  // waiting timers must not keep the test alive
  const later = globalThis.setTimeout;
  Object.assign(globalThis, {
    WebSocket: FakeSocket,
    setTimeout: (call: () => void, pause: number) => {
      const timer = later(call, pause);
      timer.unref();
      return timer;
    },
  });
  FakeSocket.made = [];
  session = new Session("ws://here/ws");
  session.open();
  socket = FakeSocket.made[0]!;
  socket.open();
});

const newest = () => FakeSocket.made.at(-1)!;
const pause = (milliseconds: number) =>
  new Promise<void>((resolve) => {
    const keepAlive = setInterval(() => {}, 1000);
    setTimeout(() => {
      clearInterval(keepAlive);
      resolve();
    }, milliseconds);
  });

test("hello is the first message, and the view's own size and colours follow the answer", async () => {
  session.setView({ width: 800, height: 450, dark: true });
  assert.equal(socket.sent[0]!["type"], "hello");
  socket.sent = []; // a new server would not know of a view told before
  socket.say(HELLO);
  await pause(250);
  assert.deepEqual(socket.last("view"), { type: "view", width: 800, height: 450, dark: true });
  assert.equal(session.view.value.water, "particles");
  assert.equal(session.connected.value, true);
});

test("a sea set here shows at once and until the server confirms it", () => {
  socket.say(HELLO);
  socket.say(status(SEA));
  session.setWave({ heading_deg: 90 });
  assert.equal(session.asked.value.heading_deg, 90);
  socket.say(status(SEA)); // sent before the server had read it
  assert.equal(session.asked.value.heading_deg, 90);
  socket.say({ type: "accepted", id: socket.last("wave")!["id"], time_s: 1 });
  socket.say(status({ ...SEA, heading_deg: 90 }));
  assert.equal(session.asked.value.heading_deg, 90);
  socket.say(status({ ...SEA, heading_deg: 45 })); // somebody else
  assert.equal(session.asked.value.heading_deg, 45);
});

test("a refused sea falls back to what the server says, with the reason", () => {
  socket.say(HELLO);
  socket.say(status(SEA));
  session.setWave({ height_m: 0.9 });
  socket.say({ type: "error", id: socket.last("wave")!["id"], path: "wave.height_m", message: "too high" });
  assert.equal(session.asked.value.height_m, 0.2);
  assert.equal(session.notices.value.at(-1)!.text, "wave.height_m: too high");
  socket.say({ type: "error", id: null, path: "wave.height_m", message: "wave.height_m = 9 is too high" });
  assert.equal(session.notices.value.at(-1)!.text, "wave.height_m = 9 is too high");
});

test("a reset forgets series and marks", () => {
  socket.say(HELLO);
  socket.say({ type: "series", rows: [[0, 1], [1, 2]] });
  socket.say({ type: "marker", time_s: 1, text: "heading" });
  assert.equal(session.series.value.count, 2);
  socket.say({ type: "reset" });
  assert.equal(session.series.value.count, 0);
  assert.deepEqual(session.marks.value, []);
});

test("an order for a line names it and carries what is to happen", () => {
  socket.say(HELLO);
  session.orderLine("l", { length_m: 5.5 });
  session.orderLine("l", { cut: "fairlead" });
  const orders = socket.sent.filter(({ type }) => type === "line") as { id: number }[];
  assert.deepEqual(orders.map(({ id: _id, ...order }) => order), [
    { type: "line", name: "l", length_m: 5.5 },
    { type: "line", name: "l", cut: "fairlead" },
  ]);
});

test("after a loss it tries again by itself and is rebuilt from hello and series", async () => {
  socket.say(HELLO);
  socket.say({ type: "series", rows: [[0, 1]] });
  const picture = session.snapshot(100, 100);
  socket.break();
  await assert.rejects(picture, /connection was lost/);
  assert.equal(session.link.value.state, "lost");
  assert.equal(session.connected.value, false);
  await pause(700);
  assert.equal(FakeSocket.made.length, 2);
  newest().open();
  newest().say({ ...HELLO, columns: ["t_s"] });
  newest().say({ type: "series", rows: [[0], [1], [2]] });
  assert.equal(session.connected.value, true);
  assert.equal(session.series.value.count, 3);
});

test("a message that cannot be read is told and the next one is read", () => {
  socket.say({ ...HELLO, surprise: 1 });
  assert.match(session.notices.value.at(-1)!.text, /hello\.surprise/);
  socket.say(HELLO);
  assert.equal(session.connected.value, true);
});

test("a server of another protocol is told and not used", () => {
  socket.say({ ...HELLO, protocol: 2 });
  assert.equal(session.connected.value, false);
  assert.match(session.notices.value.at(-1)!.text, /protocol 2/);
});

test("the camera of another client is taken over, home is where it began", () => {
  socket.say(HELLO);
  socket.say({ type: "camera", azimuth_deg: 99 });
  assert.equal(session.camera.value!.azimuth_deg, 99);
  session.moveCamera((_camera, home) => home);
  assert.equal(session.camera.value!.azimuth_deg, 10);
  assert.equal(socket.last("camera")!["azimuth_deg"], 10);
});

test("a still belongs to its request", async () => {
  socket.say(HELLO);
  const asked = session.snapshot(640, 480);
  const id = Number(socket.last("snapshot")!["id"]);
  const bytes = new Uint8Array(33);
  bytes.set(new TextEncoder().encode("FLF1"));
  const header = new DataView(bytes.buffer);
  header.setUint32(4, 1, true);
  header.setUint32(8, id, true);
  header.setUint32(24, 1, true);
  socket.onmessage?.({ data: bytes.buffer });
  assert.equal((await asked).number, id);
});
