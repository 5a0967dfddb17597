/** Compass of the waves' direction of travel: a slider for mouse, touch and keys. The solid needle is what
 * is asked, the pale one what is now. Plan view with the axes of the case: +x right, +y up. */
import { useRef } from "preact/hooks";
import { arcPath, headingAt, onCircle, turnedBy, type Range } from "./angles.ts";
import { wrapDegrees } from "./camera.ts";
import { dusted, fixed } from "./format.ts";

type Props = {
  asked: number;
  now: number;
  limits: Range;
  /** Where the current flows to; NaN without. */
  current: number;
  disabled: boolean;
  onTurn: (heading_deg: number) => void;
};

const RADIUS = 58;
const STEP = 1;
const LARGE_STEP = 10;
const TICKS = Array.from({ length: 36 }, (_, index) => index * 10);

/** Degrees by which a key turns, or where it jumps to. */
function keyTurn(event: KeyboardEvent, asked: number, limits: Range): number | null {
  const step = event.shiftKey ? LARGE_STEP : STEP;
  switch (event.key) {
    case "ArrowRight":
    case "ArrowUp":
      return turnedBy(asked, step, limits);
    case "ArrowLeft":
    case "ArrowDown":
      return turnedBy(asked, -step, limits);
    case "PageUp":
      return turnedBy(asked, LARGE_STEP, limits);
    case "PageDown":
      return turnedBy(asked, -LARGE_STEP, limits);
    case "Home":
      return limits[0];
    case "End":
      return limits[1];
    default:
      return null;
  }
}

export function Dial({ asked, now, limits, current, disabled, onTurn }: Props) {
  const svg = useRef<SVGSVGElement>(null);
  const turnTo = (event: PointerEvent): void => {
    const box = svg.current?.getBoundingClientRect();
    if (!box) return;
    const right = event.clientX - (box.left + box.width / 2);
    const up = box.top + box.height / 2 - event.clientY;
    if (Math.hypot(right, up) > 4) onTurn(dusted(headingAt(right, up, limits, 1)));
  };
  const press = (event: PointerEvent): void => {
    if (disabled || event.button !== 0) return;
    svg.current?.setPointerCapture(event.pointerId);
    turnTo(event);
  };
  const drag = (event: PointerEvent): void => {
    if (!disabled && svg.current?.hasPointerCapture(event.pointerId)) turnTo(event);
  };
  const key = (event: KeyboardEvent): void => {
    const turned = disabled ? null : keyTurn(event, asked, limits);
    if (turned === null) return;
    event.preventDefault();
    onTurn(dusted(turned));
  };
  const known = Number.isFinite(asked);
  return (
    <svg
      ref={svg}
      class="dial"
      viewBox="-80 -80 160 160"
      role="slider"
      tabindex={disabled ? -1 : 0}
      aria-label="Wave heading, direction of travel"
      aria-disabled={disabled}
      aria-valuemin={dusted(limits[0])}
      aria-valuemax={dusted(limits[1])}
      aria-valuenow={dusted(known ? asked : limits[0])}
      aria-valuetext={known ? `${fixed(asked, 0)} degrees asked, ${fixed(now, 0)} now` : "unknown"}
      onPointerDown={press}
      onPointerMove={drag}
      onKeyDown={key}
    >
      <circle r={RADIUS} class="face" />
      {TICKS.map((degrees) => (
        <Tick key={degrees} degrees={degrees} />
      ))}
      <path class="allowed" d={arcPath(limits, RADIUS)} />
      {[0, 90, 180, 270].map((degrees) => {
        const { x, y } = onCircle(degrees, RADIUS + 12);
        return (
          <text key={degrees} x={x} y={y + 3.5}>
            {limits[0] < 0 ? wrapDegrees(degrees) : degrees}
          </text>
        );
      })}
      <text class="axis" x={RADIUS - 16} y={11}>
        x
      </text>
      <text class="axis" x={-9} y={-RADIUS + 19}>
        y
      </text>
      {Number.isFinite(current) && (
        <path class="current" d="M58 0 44-6v4H30v4H44v4Z" transform={`rotate(${-current})`}>
          <title>current</title>
        </path>
      )}
      {Number.isFinite(now) && <Needle kind="now" degrees={now} />}
      {known && <Needle kind="asked" degrees={asked} />}
      <circle r={3} class="hub" />
    </svg>
  );
}

function Tick({ degrees }: { degrees: number }) {
  const outer = onCircle(degrees, RADIUS - 2);
  const inner = onCircle(degrees, RADIUS - (degrees % 90 === 0 ? 10 : degrees % 30 === 0 ? 7 : 4));
  return <line class="tick" x1={inner.x} y1={inner.y} x2={outer.x} y2={outer.y} />;
}

/** An arrow along the travel with three crests behind its middle. */
function Needle({ kind, degrees }: { kind: "asked" | "now"; degrees: number }) {
  return (
    <g class={`needle ${kind}`} transform={`rotate(${-degrees})`}>
      <path d={`M-44 0H38`} />
      <path class="tip" d="M50 0 36 -6.5V6.5Z" />
      <path d="M-40-11v22M-30-11v22M-20-11v22" />
    </g>
  );
}
