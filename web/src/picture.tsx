/** The live picture: draws what the server sends, asks for the size that fits, turns gestures into views. */
import { useEffect, useRef } from "preact/hooks";
import { useSignal } from "@preact/signals";
import { goHome, listenToGestures, zoomBy } from "./gestures.ts";
import { Icon } from "./icons.tsx";
import type { Picture } from "./protocol.ts";
import type { Session } from "./session.ts";
import { isDark, QUALITIES, quality } from "./settings.ts";

const SMALLEST = { width: 160, height: 120 } as const;
const HELP =
  "Live picture of the simulation. Arrow keys turn the view, shift with arrows moves it, plus and minus zoom, Home goes back to the first view.";

export function PictureView({ session }: { session: Session }) {
  const frame = useRef<HTMLDivElement>(null);
  const canvas = useRef<HTMLCanvasElement>(null);
  const drawn = useSignal(false);

  useEffect(() => {
    if (!canvas.current) return;
    return drawPictures(session, canvas.current, () => (drawn.value = true));
  }, [session]);
  useEffect(() => {
    if (!frame.current) return;
    return listenToGestures(frame.current, (move) => session.moveCamera(move));
  }, [session]);
  useEffect(() => {
    if (!frame.current) return;
    return fitView(session, frame.current);
  }, [session, quality.value]);
  const dark = isDark();
  useEffect(() => session.setView({ dark }), [session, dark]);

  const link = session.link.value;
  const stale = link.state !== "open";
  return (
    <section class="picture" aria-label="Picture">
      <div class="frame" ref={frame} tabindex={0} role="application" aria-label={HELP}>
        <canvas ref={canvas} class={stale ? "stale" : ""} aria-hidden="true" width={16} height={9} />
        {!drawn.value && !stale && <p class="waiting">Waiting for the first picture</p>}
      </div>
      <ViewButtons session={session} />
      <Banner session={session} />
    </section>
  );
}

function ViewButtons({ session }: { session: Session }) {
  const buttons = [
    { name: "plus", label: "Zoom in", move: zoomBy(1 / 1.25) },
    { name: "minus", label: "Zoom out", move: zoomBy(1.25) },
    { name: "home", label: "First view (double click)", move: goHome },
  ] as const;
  return (
    <div class="view-buttons" role="group" aria-label="Camera">
      {buttons.map(({ name, label, move }) => (
        <button key={name} type="button" class="square" aria-label={label} title={label} onClick={() => session.moveCamera(move)}>
          <Icon name={name} />
        </button>
      ))}
    </div>
  );
}

/** Says that the connection is lost or that the run has failed. */
function Banner({ session }: { session: Session }) {
  const link = session.link.value;
  const status = session.status.value;
  if (link.state === "lost")
    return (
      <div class="banner" role="alert">
        <p>
          <strong>Connection lost.</strong> The picture is old. Trying again.
        </p>
        <button type="button" onClick={() => session.open()}>
          Try now
        </button>
      </div>
    );
  if (status?.state === "failed")
    return (
      <div class="banner failed" role="alert">
        <p>
          <strong>The run has stopped.</strong> {status.health.message}
        </p>
      </div>
    );
  return null;
}

/** Decodes and draws live pictures; each is acknowledged once it is on the screen. A hidden page does not
 * acknowledge, so that the server draws nothing for it. @return a function that stops it */
function drawPictures(session: Session, canvas: HTMLCanvasElement, first: () => void): () => void {
  let held: number | null = null;
  const acknowledge = (frame: number): void => {
    if (document.hidden) held = frame;
    else session.acknowledge(frame);
  };
  const show = async (picture: Picture): Promise<void> => {
    try {
      const bitmap = await createImageBitmap(new Blob([picture.payload]));
      if (canvas.width !== bitmap.width) canvas.width = bitmap.width;
      if (canvas.height !== bitmap.height) canvas.height = bitmap.height;
      canvas.getContext("2d")?.drawImage(bitmap, 0, 0);
      bitmap.close();
      canvas.dataset["frame"] = String(picture.number);
      first();
    } catch (error) {
      session.notify("bad", `Picture ${picture.number} cannot be decoded: ${String(error)}`);
    }
    acknowledge(picture.number);
  };
  const shown = (): void => {
    if (document.hidden || held === null) return;
    session.acknowledge(held);
    held = null;
  };
  session.onPicture = (picture) => void show(picture);
  document.addEventListener("visibilitychange", shown);
  return () => {
    session.onPicture = (picture) => session.acknowledge(picture.number);
    document.removeEventListener("visibilitychange", shown);
  };
}

/** Asks for pictures of the frame's size, in device pixels, within the quality chosen. */
function fitView(session: Session, frame: HTMLElement): () => void {
  const { width: widest, height: highest } = QUALITIES[quality.value];
  const fit = (): void => {
    const { clientWidth, clientHeight } = frame;
    if (clientWidth === 0 || clientHeight === 0) return;
    const scale = Math.min(devicePixelRatio, widest / clientWidth, highest / clientHeight);
    const even = (length: number, least: number): number => Math.max(least, 2 * Math.round((length * scale) / 2));
    const width = even(clientWidth, SMALLEST.width);
    const height = even(clientHeight, SMALLEST.height);
    const view = session.view.peek();
    if (view.width !== width || view.height !== height) session.setView({ width, height });
  };
  const observer = new ResizeObserver(fit);
  observer.observe(frame);
  return () => observer.disconnect();
}
