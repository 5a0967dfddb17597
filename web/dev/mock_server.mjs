// A stand-in for `fairlead serve` while working on the page: speaks docs/protocol.md with synthetic
// motions and pictures. Pictures are PNG even where the real server sends JPEG; the page cannot tell.
//
//     node dev/mock_server.mjs [--port 8090] [--fail-after SECONDS]
import { createReadStream, existsSync } from "node:fs";
import { createServer } from "node:http";
import { dirname, extname, join, normalize } from "node:path";
import { fileURLToPath } from "node:url";
import { crc32, makePng } from "./png.mjs";
import { WebSocketServer } from "ws";

const argument = (name, otherwise) => {
  const at = process.argv.indexOf(name);
  return at < 0 ? otherwise : Number(process.argv[at + 1]);
};
const PORT = argument("--port", 8090);
const FAIL_AFTER_S = argument("--fail-after", Infinity);
const DIST = join(dirname(fileURLToPath(import.meta.url)), "..", "dist");
const TYPES = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css" };
const SPEED = 0.4; // simulated seconds per second
const SAMPLE_S = 0.02;
const BLEND_PERIODS = 1.5;

const body = ["surge_m", "sway_m", "heave_m", "roll_deg", "pitch_deg", "yaw_deg", "fluid_fx_n", "fluid_fy_n", "fluid_fz_n", "fluid_mx_nm", "fluid_my_nm", "fluid_mz_nm"];
const line = ["fairlead_tension_n", "anchor_tension_n", "largest_tension_n", "touchdown_m"];
const columns = ["t_s", ...body.map((name) => `ship.${name}`), ...line.map((name) => `bow_line.${name}`), "g1.elevation_m", "g2.elevation_m"];
const effect = (name, kind, active, because, bytes = 0) => ({
  name, kind, active, because, bytes,
  called_by: "a case", arrays: "none", step: "", step_limit_s: null, source: "synthetic",
  cost: kind === "pair" ? "sampled" : "clocked",
});
const HELLO = {
  type: "hello",
  protocol: 1,
  version: "0.1.0-mock",
  case: { name: "mock_ship", title: "Single-point-moored ship, 1:10, synthetic", hash: crc32(Buffer.from("mock")).toString(16) },
  backend: "cpu",
  threads: 2,
  renderer: "none: synthetic pictures",
  particles: 148213,
  spacing_m: 0.06,
  columns,
  bodies: ["ship"],
  lines: ["bow_line"],
  gauges: ["g1", "g2"],
  winches: [{ length_m: [5, 7], speed_ms: 0.2 }],
  limits: { height_m: [0.05, 0.4], period_s: [1.2, 2.6], heading_deg: [-180, 180] },
  current: null,
  warnings: ["The undriven interior is shorter than one wave length at the longest period allowed."],
  effects: [
    effect("artificial_viscosity", "pair", true, "alpha is 0.002"),
    effect("density_diffusion", "pair", true, "delta is 0.1"),
    effect("walls", "pass", true, "the bed has dummy particles", 8_400_000),
    effect("wave_ring", "pass", true, "the domain is a basin with regular waves", 2_100_000),
    effect("relaxation_zone", "pass", true, "the domain is a basin with regular waves", 240_000),
    effect("piston", "pass", false, "the domain is not a flume"),
    effect("damping_beach", "pass", false, "the domain is not a flume"),
    effect("bodies", "pass", true, "the case has one body", 640_000),
    effect("mooring_lines", "pass", true, "the case has one line", 9_000),
    effect("wave_gauges", "pass", true, "the case has two gauges", 400),
    effect("pressure_probes", "pass", false, "the case has no pressure probes"),
  ],
};
const SHARES = { base: 0.61, walls: 0.17, wave_ring: 0.06, relaxation_zone: 0.05, bodies: 0.07, mooring_lines: 0.03, wave_gauges: 0.01 };
const FIRST_SEA = { height_m: 0.3, period_s: 1.58, heading_deg: 0 };

const view = { width: 960, height: 540, water: "surface", field: "none", dark: false };
const camera = { azimuth_deg: -60, elevation_deg: 18, distance_m: 7, target_m: [0, 0, 0] };
const clients = new Map(); // socket → whether its last picture is acknowledged
let run;
begin("running");

function begin(state) {
  run = { state, time: 0, rows: [], marks: [], asked: { ...FIRST_SEA }, from: { ...FIRST_SEA }, changedAt: -Infinity, frame: 0 };
}

function seaNow() {
  const part = Math.min(1, Math.max(0, (run.time - run.changedAt) / (BLEND_PERIODS * run.asked.period_s)));
  const blend = part ** 3 * (10 - 15 * part + 6 * part * part);
  const between = (key) => run.from[key] + blend * (run.asked[key] - run.from[key]);
  return { sea: { height_m: between("height_m"), period_s: between("period_s"), heading_deg: between("heading_deg") }, changing: part < 1 };
}

function sampleRow() {
  const { sea } = seaNow();
  const phase = (2 * Math.PI * run.time) / FIRST_SEA.period_s;
  const heading = (sea.heading_deg * Math.PI) / 180;
  const a = sea.height_m / 2;
  const wave = (lag) => a * Math.sin(phase - lag);
  const motion = [0.6 * wave(1) * Math.cos(heading) + 0.1 * a * run.time ** 0.5, 0.5 * wave(1.2) * Math.sin(heading), 0.7 * wave(0.4)];
  const turn = [40 * wave(0.2) * Math.sin(heading), 50 * wave(2) * Math.cos(heading), 12 * wave(1.7) * Math.sin(2 * heading)];
  const slam = 160 * Math.max(0, Math.sin(phase - 0.9)) ** 24;
  const force = [300 * wave(0), 250 * wave(0.3) * Math.sin(heading), 4080 + 900 * wave(0.5) + slam];
  const tension = 22 + 260 * Math.max(0, motion[0]) ** 2 + 4 * Math.sin(phase * 2);
  return [run.time, ...motion, ...turn, ...force, ...turn.map((v) => v * 9), tension, tension * 0.8, tension * 1.1, 1.2 - motion[0], wave(0), wave(0.8)]
    .map((value) => Number(value.toPrecision(7)));
}

function mark(text) {
  const marker = { type: "marker", time_s: run.time, text };
  run.marks.push(marker);
  broadcast(marker);
}

function broadcast(message, except) {
  const text = JSON.stringify(message);
  for (const socket of clients.keys()) if (socket !== except) socket.send(text);
}

function status() {
  const { sea, changing } = seaNow();
  const running = run.state === "running";
  const failed = run.state === "failed";
  return {
    type: "status",
    time_s: run.time,
    state: run.state,
    speed: running ? SPEED : 0,
    step: Math.round(run.time / 4.1e-4),
    time_step_s: 4.1e-4,
    particle_steps_per_s: running ? 5.2e6 : 0,
    density_error: 0.0041 + 0.001 * Math.sin(run.time),
    frames_per_s: clients.size > 0 ? 6 : 0,
    clients: clients.size,
    health: failed ? { status: "failed", message: "bodies: ship.heave is not a number at t = 4.21 s" } : { status: "good", message: "" },
    wave: { asked: run.asked, now: sea, changing },
    lines: [{ length_m: run.length ?? 6, asked_m: run.length ?? null, largest_n: 52.3, parted: run.parted ?? false }],
    shares: SHARES,
  };
}

setInterval(() => {
  if (run.state !== "running") return;
  const rows = [];
  for (let passed = 0; passed < 0.05 * SPEED; passed += SAMPLE_S) {
    run.time = Number((run.time + SAMPLE_S).toFixed(6));
    rows.push(sampleRow());
  }
  run.rows.push(...rows);
  broadcast({ type: "series", rows });
  if (run.time > FAIL_AFTER_S) run.state = "failed";
}, 50);
setInterval(() => broadcast(status()), 200);
setInterval(() => {
  const free = [...clients].filter(([, acknowledged]) => acknowledged).map(([socket]) => socket);
  if (free.length === 0) return;
  const picture = pictureMessage(0, ++run.frame, view.width, view.height);
  for (const socket of free) {
    clients.set(socket, false);
    socket.send(picture);
  }
}, 160);

/** A sea of stripes under a sky, seen from the camera's azimuth and height. */
function pictureMessage(kind, number, width, height) {
  const { sea } = seaNow();
  const horizon = Math.round(height * (0.5 - camera.elevation_deg / 120));
  const turn = ((sea.heading_deg - camera.azimuth_deg) * Math.PI) / 180;
  const [sky, far] = view.dark ? [30, 18] : [214, 150];
  const payload = makePng(width, height, (x, y) => {
    if (y < horizon) return [sky - 10, sky, sky + 12];
    const depth = (camera.distance_m * 40) / (y - horizon + 8);
    const across = ((x - width / 2) / width) * depth * 3;
    const wave = Math.sin((depth * Math.cos(turn) + across * Math.sin(turn)) * 3 + run.time * 4);
    const shade = far * (0.62 + 0.22 * wave * sea.height_m * 3);
    if (Math.abs(x - width / 2) < width * 0.12 && Math.abs(y - height * 0.6) < height * 0.06) return [150, 52, 40];
    return [shade * 0.35, shade * 0.75, shade];
  });
  const header = Buffer.alloc(32);
  header.write("FLF1");
  header.writeUInt32LE(kind, 4);
  header.writeUInt32LE(number, 8);
  header.writeUInt16LE(width, 12);
  header.writeUInt16LE(height, 14);
  header.writeDoubleLE(run.time, 16);
  header.writeUInt32LE(payload.length, 24);
  return Buffer.concat([header, payload]);
}

const HANDLERS = {
  hello(socket) {
    socket.send(JSON.stringify({ ...HELLO, camera, view }));
    socket.send(JSON.stringify(status()));
    socket.send(JSON.stringify({ type: "series", rows: run.rows }));
    for (const marker of run.marks) socket.send(JSON.stringify(marker));
    clients.set(socket, true);
  },
  ack(socket) {
    clients.set(socket, true);
  },
  view(socket, { type, ...change }) {
    Object.assign(view, change);
    broadcast({ type, ...change }, socket);
  },
  camera(socket, { type, ...change }) {
    Object.assign(camera, change);
    broadcast({ type, ...change }, socket);
  },
  wave(socket, { id, type: _type, ...change }) {
    for (const [key, value] of Object.entries(change)) {
      const [min, max] = HELLO.limits[key];
      if (value >= min && value <= max) continue;
      return socket.send(JSON.stringify({ type: "error", id, path: `wave.${key}`, message: `${value} is not in ${min} to ${max}` }));
    }
    run.from = seaNow().sea;
    run.asked = { ...run.asked, ...change };
    run.changedAt = run.time;
    socket.send(JSON.stringify({ type: "accepted", id, time_s: run.time }));
    mark(Object.entries(change).map(([key, value]) => `${key.replace("_", " ")} ${value}`).join(", "));
  },
  line(socket, { id, name, length_m, cut }) {
    if (length_m !== undefined) run.length = length_m;
    if (cut !== undefined) run.parted = true;
    socket.send(JSON.stringify({ type: "accepted", id, time_s: run.time }));
    mark(cut === undefined ? `${name} to ${length_m} m` : `${name} cut at ${cut}`);
  },
  run(socket, { id, action }) {
    if (action === "reset") {
      begin(run.state);
      broadcast({ type: "reset" });
    } else run.state = action === "start" ? "running" : "paused";
    socket.send(JSON.stringify({ type: "accepted", id, time_s: run.time }));
    if (action === "reset") mark("reset");
  },
  snapshot(socket, { id, width, height }) {
    socket.send(pictureMessage(1, id, width, height));
  },
};

const server = createServer((request, response) => {
  const path = normalize(new URL(request.url, "http://x").pathname);
  const file = join(DIST, path === "/" ? "index.html" : path);
  if (!existsSync(file)) return response.writeHead(404).end();
  response.writeHead(200, { "content-type": TYPES[extname(file)] ?? "application/octet-stream" });
  createReadStream(file).pipe(response);
});
const sockets = new WebSocketServer({ server, path: "/ws" });
sockets.on("connection", (socket) => {
  socket.on("message", (data) => {
    const message = JSON.parse(data.toString());
    HANDLERS[message.type](socket, message);
  });
  socket.on("close", () => clients.delete(socket));
});
server.listen(PORT, "127.0.0.1", () => console.log(`mock on http://127.0.0.1:${PORT}`));
