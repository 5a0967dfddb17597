import assert from "node:assert/strict";
import { test } from "node:test";
import { DecodeError } from "./decode.ts";
import { parseMessage, parsePicture } from "./protocol.ts";

const STATUS = {
  type: "status",
  time_s: 1.5,
  state: "running",
  speed: 0.2,
  step: 100,
  time_step_s: 3e-4,
  particle_steps_per_s: 5e6,
  density_error: 0.004,
  frames_per_s: 8,
  clients: 1,
  health: { status: "good", message: "" },
  wave: {
    asked: { height_m: 0.3, period_s: 1.58, heading_deg: 30 },
    now: { height_m: 0.3, period_s: 1.58, heading_deg: 10 },
    changing: true,
  },
  lines: [{ length_m: 6, asked_m: null, largest_n: 40, parted: false }],
  shares: { base: 0.6, walls: 0.1 },
};

const HELLO = {
  type: "hello",
  protocol: 1,
  version: "0.1.0",
  case: { name: "moored_ship", title: "Moored ship", hash: "00ff" },
  backend: "cpu",
  threads: 2,
  renderer: "EGL surfaceless",
  particles: 1000,
  spacing_m: 0.05,
  columns: ["t_s", "ship.heave_m"],
  bodies: ["ship"],
  lines: [],
  gauges: [],
  winches: [{ length_m: [4, 8], speed_ms: 0.1 }, null],
  limits: { height_m: [0.05, 0.4], period_s: [1, 2.6], heading_deg: [-180, 180] },
  current: { speed_ms: 0.3, heading_deg: 30 },
  camera: { azimuth_deg: 120, elevation_deg: 15, distance_m: 8, target_m: [0, 0, 0] },
  view: { width: 960, height: 540, water: "surface", field: "none", dark: false },
  warnings: ["coarse"],
  effects: [{
    name: "walls", kind: "pass", active: true, because: "a tank has walls", called_by: "domain.kind", bytes: 100,
    arrays: "dummies", step_limit_s: null, step: "", cost: "clocked", source: "Adami et al. 2012",
  }],
};

function parse(value: unknown) {
  return parseMessage(JSON.stringify(value));
}

test("a hello and a status as documented are read", () => {
  const hello = parse(HELLO);
  assert.equal(hello.type, "hello");
  assert.deepEqual(hello.type === "hello" && hello.limits?.heading_deg, [-180, 180]);
  assert.equal(hello.type === "hello" && hello.current?.heading_deg, 30);
  const status = parse(STATUS);
  assert.equal(status.type === "status" && status.wave?.now.heading_deg, 10);
  assert.equal(status.type === "status" && status.shares.get("base"), 0.6);
});

test("a case without live waves has null limits and a null wave", () => {
  const hello = parse({ ...HELLO, limits: null });
  assert.equal(hello.type === "hello" && hello.limits, null);
  const status = parse({ ...STATUS, wave: null });
  assert.equal(status.type === "status" && status.wave, null);
});

test("null in a series row is read as not-a-number", () => {
  const series = parse({ type: "series", rows: [[0, null], [0.1, 2]] });
  assert.ok(series.type === "series");
  assert.ok(Number.isNaN(series.rows[0]![1]));
  assert.equal(series.rows[1]![1], 2);
});

test("view and camera changes may name any subset of their keys", () => {
  assert.deepEqual(parse({ type: "view", water: "particles" }), { type: "view", water: "particles" });
  assert.deepEqual(parse({ type: "camera", azimuth_deg: 3 }), { type: "camera", azimuth_deg: 3 });
});

test("the unknown is refused with its path", () => {
  const refused = (value: unknown, path: string) =>
    assert.throws(() => parse(value), (error) => error instanceof DecodeError && error.path === path);
  refused({ type: "goodbye" }, "type");
  refused({ type: "toString" }, "type");
  refused([], "type");
  refused({ ...STATUS, surprise: 1 }, "status.surprise");
  refused({ ...STATUS, state: "asleep" }, "status.state");
  refused({ ...STATUS, step: "many" }, "status.step");
  refused({ ...STATUS, health: { status: "good" } }, "status.health.message");
  refused({ ...HELLO, limits: { ...HELLO.limits, period_s: [2, 1] } }, "hello.limits.period_s");
  refused({ ...HELLO, columns: ["t_s", 7] }, "hello.columns[1]");
  refused({ type: "view", field: "taste" }, "view.field");
  refused({ type: "camera", target_m: [1, 2] }, "camera.target_m");
  assert.throws(() => parseMessage("not json"), SyntaxError);
});

function pictureBytes(change: (header: DataView) => void = () => {}): ArrayBuffer {
  const bytes = new Uint8Array(32 + 3);
  bytes.set(new TextEncoder().encode("FLF1"));
  const header = new DataView(bytes.buffer);
  header.setUint32(8, 77, true);
  header.setUint16(12, 960, true);
  header.setUint16(14, 540, true);
  header.setFloat64(16, 12.5, true);
  header.setUint32(24, 3, true);
  bytes.set([1, 2, 3], 32);
  change(header);
  return bytes.buffer;
}

test("a picture's header is read little-endian and its payload is what follows", () => {
  const picture = parsePicture(pictureBytes());
  assert.deepEqual(
    { ...picture, payload: [...picture.payload] },
    { kind: "live", number: 77, width: 960, height: 540, time_s: 12.5, payload: [1, 2, 3] },
  );
  assert.equal(parsePicture(pictureBytes((header) => header.setUint32(4, 1, true))).kind, "snapshot");
});

test("a picture with a wrong magic, kind or length is refused", () => {
  assert.throws(() => parsePicture(pictureBytes((header) => header.setUint8(3, 50))), DecodeError);
  assert.throws(() => parsePicture(pictureBytes((header) => header.setUint32(4, 2, true))), DecodeError);
  assert.throws(() => parsePicture(pictureBytes((header) => header.setUint32(24, 4, true))), DecodeError);
  assert.throws(() => parsePicture(new ArrayBuffer(31)), DecodeError);
});
