/** The run as the page knows it: what the server said, as signals, and what may be asked of it. */
import { batch, computed, signal } from "@preact/signals";
import { Connection } from "./connection.ts";
import type { Mark } from "./markers.ts";
import {
  PROTOCOL,
  type Camera,
  type Hello,
  type LineOrder,
  type Picture,
  type Refused,
  type RunAction,
  type ServerMessage,
  type Status,
  type View,
  type Wave,
} from "./protocol.ts";
import { SeriesStore } from "./series.ts";
import { throttle } from "./throttle.ts";

const WAVE_INTERVAL_MS = 100;
const CAMERA_INTERVAL_MS = 40;
const VIEW_INTERVAL_MS = 200;
const SNAPSHOT_PATIENCE_MS = 30_000;
const NOTICE_MS = 8000;

export type Notice = { id: number; tone: "info" | "bad"; text: string };
export type Link = { state: "connecting" } | { state: "open" } | { state: "lost"; retryAt: number };
export type Snapshot = { picture: Picture; run: Hello["case"] };

const NO_SEA: Wave = { height_m: NaN, period_s: NaN, heading_deg: NaN };

export class Session {
  readonly link = signal<Link>({ state: "connecting" });
  readonly hello = signal<Hello | null>(null);
  readonly status = signal<Status | null>(null);
  readonly camera = signal<Camera | null>(null);
  readonly view = signal<View>({});
  readonly marks = signal<readonly Mark[]>([]);
  readonly notices = signal<readonly Notice[]>([]);
  readonly series = signal(new SeriesStore(["t_s"]));
  /** Counts up whenever rows came: what draws the series depends on it. */
  readonly rowsSeen = signal(0);
  /** Sea set here that the server has not confirmed yet. */
  private readonly wanted = signal<Partial<Wave> | null>(null);
  /** The sea asked for: as set here, else as the server says. */
  readonly asked = computed<Wave>(() => ({ ...NO_SEA, ...this.status.value?.wave?.asked, ...this.wanted.value }));
  readonly now = computed<Wave>(() => this.status.value?.wave?.now ?? NO_SEA);
  readonly connected = computed(() => this.link.value.state === "open" && this.hello.value !== null);

  /** Who draws the live pictures; told to acknowledge each with `acknowledge`. */
  onPicture: (picture: Picture) => void = (picture) => this.acknowledge(picture.number);

  private readonly connection: Connection;
  private nextId = 1;
  private lastWaveId = 0;
  private waveAccepted = false;
  private home: Camera | null = null;
  private ownView: View = {};
  private readonly snapshots = new Map<number, { done: (picture: Picture) => void; failed: (reason: string) => void }>();

  constructor(url: string) {
    this.connection = new Connection(url, {
      opened: () => {},
      lost: (retryAt) => this.lost(retryAt),
      message: (message) => batch(() => this.receive(message)),
      picture: (picture) => this.receivePicture(picture),
      unreadable: (error) => this.notify("bad", `Message not understood: ${String(error)}`),
    });
  }

  open(): void {
    this.connection.open();
  }

  /** Act at once, at most ten times a second; the last value is certain. */
  setWave(change: Partial<Wave>): void {
    this.wanted.value = { ...this.wanted.value, ...change };
    this.waveAccepted = false;
    this.sendWave(change);
  }

  /** Turn a line's winch, or cut it; a refusal comes as a notice. */
  orderLine(name: string, order: LineOrder): void {
    this.connection.send({ type: "line", id: this.nextId++, name, ...order });
  }

  run(action: RunAction): void {
    this.connection.send({ type: "run", id: this.nextId++, action });
  }

  setView(change: View): void {
    this.view.value = { ...this.view.value, ...change };
    this.ownView = { ...this.ownView, ...change };
    this.sendView(change);
  }

  moveCamera(move: (camera: Camera, home: Camera) => Camera): void {
    if (!this.camera.value || !this.home) return;
    this.camera.value = move(this.camera.value, this.home);
    this.sendCamera(this.camera.value);
  }

  acknowledge(frame: number): void {
    this.connection.send({ type: "ack", frame });
  }

  /** @return the picture as PNG. Rejects with the server's reason, or after half a minute. */
  snapshot(width: number, height: number): Promise<Picture> {
    const id = this.nextId++;
    return new Promise<Picture>((resolve, reject) => {
      const failed = (reason: string): void => {
        this.snapshots.delete(id);
        reject(new Error(reason));
      };
      this.snapshots.set(id, { done: resolve, failed });
      if (!this.connection.send({ type: "snapshot", id, width, height })) return failed("there is no connection");
      setTimeout(() => failed("no answer in half a minute"), SNAPSHOT_PATIENCE_MS);
    });
  }

  notify(tone: Notice["tone"], text: string): void {
    const id = this.nextId++;
    this.notices.value = [...this.notices.value.slice(-2), { id, tone, text }];
    setTimeout(() => this.dismiss(id), NOTICE_MS);
  }

  dismiss(id: number): void {
    this.notices.value = this.notices.value.filter((notice) => notice.id !== id);
  }

  private readonly sendWave = throttle<Partial<Wave>>(
    WAVE_INTERVAL_MS,
    (change) => {
      this.lastWaveId = this.nextId++;
      if (!this.connection.send({ type: "wave", id: this.lastWaveId, ...change })) this.wanted.value = null;
    },
    (waiting, newer) => ({ ...waiting, ...newer }),
  );

  private readonly sendView = throttle<View>(
    VIEW_INTERVAL_MS,
    (view) => this.connection.send({ type: "view", ...view }),
    (waiting, newer) => ({ ...waiting, ...newer }),
  );

  private readonly sendCamera = throttle<Camera>(CAMERA_INTERVAL_MS, (camera) =>
    this.connection.send({ type: "camera", ...camera }),
  );

  private receive(message: ServerMessage): void {
    switch (message.type) {
      case "hello":
        return this.greet(message);
      case "status":
        this.status.value = message;
        if (this.waveAccepted) this.wanted.value = null;
        return;
      case "series":
        this.series.value.append(message.rows);
        this.rowsSeen.value++;
        return;
      case "marker":
        // a snap is told when its peak is over: its mark may lie before the last one
        this.marks.value = [...this.marks.value, { time_s: message.time_s, text: message.text }].sort((a, b) => a.time_s - b.time_s);
        return;
      case "accepted":
        if (message.id === this.lastWaveId) this.waveAccepted = true;
        return;
      case "error":
        return this.refuse(message);
      case "reset":
        return this.forget();
      case "view": {
        const { type: _type, ...view } = message;
        this.view.value = { ...this.view.value, ...view };
        return;
      }
      case "camera": {
        const { type: _type, ...camera } = message;
        if (this.camera.value) this.camera.value = { ...this.camera.value, ...camera };
        return;
      }
    }
  }

  /** The state is rebuilt from nothing: after a loss the server may be a new one with another case. */
  private greet(hello: Hello): void {
    if (hello.protocol !== PROTOCOL)
      return this.notify("bad", `The server speaks protocol ${hello.protocol}, this page ${PROTOCOL}: load it anew.`);
    if (this.hello.value?.case.hash !== hello.case.hash || !this.home) this.home = hello.camera;
    this.link.value = { state: "open" };
    this.hello.value = hello;
    this.series.value = new SeriesStore(hello.columns);
    this.forget();
    this.camera.value = hello.camera;
    // size and colours are this page's own; what is shown of the water is the session's
    this.view.value = { ...hello.view, ...this.ownView, water: hello.view.water, field: hello.view.field } as View;
    const { water: _water, field: _field, ...own } = this.ownView;
    this.sendView(own);
  }

  private forget(): void {
    this.series.value.clear();
    this.rowsSeen.value++;
    this.marks.value = [];
    this.wanted.value = null;
  }

  private refuse(error: Refused): void {
    const waiting = error.id === null ? undefined : this.snapshots.get(error.id);
    if (waiting) return waiting.failed(error.message);
    if (error.id === this.lastWaveId) this.wanted.value = null;
    const named = error.path === "" || error.message.startsWith(error.path);
    this.notify("bad", named ? error.message : `${error.path}: ${error.message}`);
  }

  private receivePicture(picture: Picture): void {
    if (picture.kind === "live") return this.onPicture(picture);
    const waiting = this.snapshots.get(picture.number);
    this.snapshots.delete(picture.number);
    waiting?.done(picture);
  }

  private lost(retryAt: number): void {
    this.link.value = { state: "lost", retryAt };
    this.wanted.value = null;
    for (const { failed } of [...this.snapshots.values()]) failed("the connection was lost");
  }
}
