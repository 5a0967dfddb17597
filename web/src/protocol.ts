/**
 * The wire, protocol version 1 (docs/protocol.md), as types and as pure functions between bytes and
 * types. What does not fit the document throws a DecodeError; nothing is guessed.
 */
import {
  DecodeError,
  dictionary,
  fields,
  flag,
  list,
  number,
  numberOrNaN,
  object,
  oneOf,
  orNull,
  range,
  text,
  vector,
  type Reader,
} from "./decode.ts";

export const PROTOCOL = 1;
export const SUBPROTOCOL = "fairlead";

type Value<R> = R extends Reader<infer T> ? T : never;

const camera = object({
  azimuth_deg: number,
  elevation_deg: number,
  distance_m: number,
  target_m: vector,
});
/** Orbit camera: the eye stands at azimuth/elevation seen from the target. */
export type Camera = Value<typeof camera>;

export const WATER_MODES = ["surface", "particles"] as const;
export const COLOUR_FIELDS = ["none", "elevation", "speed", "pressure"] as const;

const view = fields({
  width: number,
  height: number,
  water: oneOf(...WATER_MODES),
  field: oneOf(...COLOUR_FIELDS),
  dark: flag,
});
export type View = Value<typeof view>;
export type WaterMode = (typeof WATER_MODES)[number];
export type ColourField = (typeof COLOUR_FIELDS)[number];

const wave = object({ height_m: numberOrNaN, period_s: numberOrNaN, heading_deg: numberOrNaN });
/** A regular sea: height crest to trough, period, direction of travel (0 along +x, 90 along +y). */
export type Wave = Value<typeof wave>;
export type WaveKey = keyof Wave;

const limits = object({ height_m: range, period_s: range, heading_deg: range });
export type Limits = Value<typeof limits>;

const current = object({ speed_ms: number, heading_deg: number });
/** A steady current: its full speed and where it flows to. */
export type Current = Value<typeof current>;

const winch = object({ length_m: range, speed_ms: number });
/** What may be done to a line's length: the whole line's shortest and longest, and how fast. */
export type Winch = Value<typeof winch>;

export const CUT_PLACES = ["anchor", "middle", "fairlead"] as const;
export type CutPlace = (typeof CUT_PLACES)[number];
/** What is to happen to a line. */
export type LineOrder = { length_m?: number; cut?: CutPlace };

const lineStatus = object({ length_m: numberOrNaN, asked_m: numberOrNaN, largest_n: numberOrNaN, parted: flag });
export type LineStatus = Value<typeof lineStatus>;

const effect = object({
  name: text,
  kind: oneOf("pair", "pass"),
  active: flag,
  because: text,
  called_by: text,
  bytes: number,
  arrays: text,
  step_limit_s: numberOrNaN,
  step: text,
  cost: oneOf("clocked", "sampled", "elsewhere"),
  source: text,
});
export type Effect = Value<typeof effect>;

const hello = object({
  type: oneOf("hello"),
  protocol: number,
  version: text,
  case: object({ name: text, title: text, hash: text }),
  backend: text,
  threads: number,
  renderer: text,
  particles: number,
  spacing_m: number,
  columns: list(text),
  bodies: list(text),
  lines: list(text),
  gauges: list(text),
  winches: list(orNull(winch)),
  limits: orNull(limits),
  current: orNull(current),
  camera,
  view,
  warnings: list(text),
  effects: list(effect),
});
export type Hello = Value<typeof hello>;

const status = object({
  type: oneOf("status"),
  time_s: numberOrNaN,
  state: oneOf("running", "paused", "failed"),
  speed: numberOrNaN,
  step: number,
  time_step_s: numberOrNaN,
  particle_steps_per_s: numberOrNaN,
  density_error: numberOrNaN,
  frames_per_s: numberOrNaN,
  clients: number,
  health: object({ status: oneOf("good", "recovered", "failed"), message: text }),
  wave: orNull(object({ asked: wave, now: wave, changing: flag })),
  lines: list(lineStatus),
  shares: dictionary(numberOrNaN),
});
export type Status = Value<typeof status>;
export type RunState = Status["state"];

const series = object({ type: oneOf("series"), rows: list(list(numberOrNaN)) });
const marker = object({ type: oneOf("marker"), time_s: number, text });
const accepted = object({ type: oneOf("accepted"), id: number, time_s: numberOrNaN });
const refused = object({ type: oneOf("error"), id: orNull(number), path: text, message: text });
const reset = object({ type: oneOf("reset") });

export type Series = Value<typeof series>;
export type Marker = Value<typeof marker>;
export type Accepted = Value<typeof accepted>;
export type Refused = Value<typeof refused>;
export type ViewChange = { type: "view" } & View;
export type CameraChange = { type: "camera" } & Partial<Camera>;

export type ServerMessage =
  | Hello
  | Status
  | Series
  | Marker
  | Accepted
  | Refused
  | Value<typeof reset>
  | ViewChange
  | CameraChange;

const viewChange: Reader<ViewChange> = (value, path) => ({ type: "view", ...view(withoutType(value), path) });
const cameraFields = fields({
  azimuth_deg: number,
  elevation_deg: number,
  distance_m: number,
  target_m: vector,
});
const cameraChange: Reader<CameraChange> = (value, path) => ({
  type: "camera",
  ...cameraFields(withoutType(value), path),
});

function withoutType(value: unknown): unknown {
  const { type: _type, ...rest } = value as { type: string };
  return rest;
}

const READERS: { [T in ServerMessage["type"]]: Reader<Extract<ServerMessage, { type: T }>> } = {
  hello,
  status,
  series,
  marker,
  accepted,
  error: refused,
  reset,
  view: viewChange,
  camera: cameraChange,
};

/** Reads a text message of the server. @throws DecodeError, SyntaxError (not JSON) */
export function parseMessage(json: string): ServerMessage {
  const value: unknown = JSON.parse(json);
  if (typeof value !== "object" || value === null) throw new DecodeError("message", "an object", value);
  const type: unknown = "type" in value ? value.type : undefined;
  if (typeof type !== "string" || !Object.hasOwn(READERS, type))
    throw new DecodeError("type", "a known message type", type);
  return READERS[type as ServerMessage["type"]](value, type);
}

export type ClientMessage =
  | { type: "hello"; protocol: number }
  | { type: "ack"; frame: number }
  | ({ type: "view" } & View)
  | ({ type: "camera" } & Camera)
  | ({ type: "wave"; id: number } & Partial<Wave>)
  | ({ type: "line"; id: number; name: string } & LineOrder)
  | { type: "run"; id: number; action: RunAction }
  | { type: "snapshot"; id: number; width: number; height: number };

export type RunAction = "start" | "pause" | "reset";

export type Picture = {
  readonly kind: "live" | "snapshot";
  /** live: frame to acknowledge; snapshot: id of the request */
  readonly number: number;
  readonly width: number;
  readonly height: number;
  readonly time_s: number;
  /** the encoded picture, a view into the message */
  readonly payload: Uint8Array<ArrayBuffer>;
};

const HEADER_BYTES = 32;
const MAGIC = 0x31464c46; // "FLF1", little-endian

/** Reads a binary message of the server. @throws DecodeError */
export function parsePicture(message: ArrayBuffer): Picture {
  if (message.byteLength < HEADER_BYTES)
    throw new DecodeError("picture", `at least ${HEADER_BYTES} bytes`, message.byteLength);
  const header = new DataView(message, 0, HEADER_BYTES);
  const magic = header.getUint32(0, true);
  if (magic !== MAGIC) throw new DecodeError("picture.magic", "FLF1", magic);
  const kind = header.getUint32(4, true);
  if (kind !== 0 && kind !== 1) throw new DecodeError("picture.kind", "0 or 1", kind);
  const length = header.getUint32(24, true);
  if (length !== message.byteLength - HEADER_BYTES)
    throw new DecodeError("picture.length", `${message.byteLength - HEADER_BYTES}`, length);
  return {
    kind: kind === 0 ? "live" : "snapshot",
    number: header.getUint32(8, true),
    width: header.getUint16(12, true),
    height: header.getUint16(14, true),
    time_s: header.getFloat64(16, true),
    payload: new Uint8Array(message, HEADER_BYTES, length),
  };
}
