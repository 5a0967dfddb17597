/** Mouse, touch and keys over the picture, turned into camera moves. */
import { orbit, pan, zoom } from "./camera.ts";
import type { Camera } from "./protocol.ts";

export type MoveCamera = (move: (camera: Camera, home: Camera) => Camera) => void;

const KEY_ORBIT = 1 / 36; // of the picture's height: 5 degrees
const KEY_PAN = 0.05;
const KEY_ZOOM = 1.15;
const WHEEL_ZOOM = 0.0015; // per pixel of wheel travel
const WHEEL_LINE_PX = 32;

export const goHome: Parameters<MoveCamera>[0] = (_camera, home) => home;
export const zoomBy =
  (factor: number): Parameters<MoveCamera>[0] =>
  (camera, home) =>
    zoom(camera, factor, home);

const ARROWS: Readonly<Record<string, readonly [number, number]>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
};

/** @return whether the key was one of ours */
function pressKey(event: KeyboardEvent, move: MoveCamera): boolean {
  if (event.ctrlKey || event.metaKey || event.altKey) return false;
  const arrow = ARROWS[event.key];
  if (arrow) {
    const [right, down] = arrow;
    if (event.shiftKey) move((camera) => pan(camera, -right * KEY_PAN, -down * KEY_PAN));
    else move((camera) => orbit(camera, right * KEY_ORBIT, down * KEY_ORBIT));
  } else if (event.key === "+" || event.key === "=") move(zoomBy(1 / KEY_ZOOM));
  else if (event.key === "-") move(zoomBy(KEY_ZOOM));
  else if (event.key === "Home" || event.key === "0") move(goHome);
  else return false;
  return true;
}

type Point = { x: number; y: number };
const middle = (points: readonly Point[]): Point => ({
  x: points.reduce((sum, point) => sum + point.x, 0) / points.length,
  y: points.reduce((sum, point) => sum + point.y, 0) / points.length,
});
const spread = ([a, b]: readonly Point[]): number => (a && b ? Math.hypot(a.x - b.x, a.y - b.y) : 0);

/** One finger or button orbits; shift, the other buttons or two fingers pan; pinching zooms. */
class Pointers {
  private readonly down = new Map<number, Point>();

  constructor(
    private readonly element: HTMLElement,
    private readonly move: MoveCamera,
  ) {}

  press(event: PointerEvent): void {
    this.element.setPointerCapture(event.pointerId);
    this.down.set(event.pointerId, { x: event.clientX, y: event.clientY });
  }

  drag(event: PointerEvent): void {
    if (!this.down.has(event.pointerId)) return;
    const before = [...this.down.values()];
    this.down.set(event.pointerId, { x: event.clientX, y: event.clientY });
    const after = [...this.down.values()];
    const height = this.element.clientHeight || 1;
    const right = (middle(after).x - middle(before).x) / height;
    const down = (middle(after).y - middle(before).y) / height;
    if (after.length > 1) {
      const factor = spread(before) / Math.max(1, spread(after));
      this.move((camera, home) => zoom(pan(camera, right, down), factor, home));
    } else if (event.shiftKey || (event.buttons & ~1) !== 0) this.move((camera) => pan(camera, right, down));
    else this.move((camera) => orbit(camera, right, down));
  }

  release(event: PointerEvent): void {
    this.down.delete(event.pointerId);
  }
}

/** Listens on the element. @return a function that stops it */
export function listenToGestures(element: HTMLElement, move: MoveCamera): () => void {
  const pointers = new Pointers(element, move);
  const stop = new AbortController();
  const options = { signal: stop.signal };
  element.addEventListener("pointerdown", (event) => pointers.press(event), options);
  element.addEventListener("pointermove", (event) => pointers.drag(event), options);
  for (const end of ["pointerup", "pointercancel", "lostpointercapture"] as const)
    element.addEventListener(end, (event) => pointers.release(event), options);
  element.addEventListener("dblclick", () => move(goHome), options);
  element.addEventListener("contextmenu", (event) => event.preventDefault(), options);
  element.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      const travel = event.deltaY * (event.deltaMode === WheelEvent.DOM_DELTA_LINE ? WHEEL_LINE_PX : 1);
      move(zoomBy(Math.exp(travel * WHEEL_ZOOM)));
    },
    { ...options, passive: false },
  );
  element.addEventListener(
    "keydown",
    (event) => {
      if (pressKey(event, move)) event.preventDefault();
    },
    options,
  );
  return () => stop.abort();
}
