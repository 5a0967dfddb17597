/** One panel: its legend with values, its chart, and a cursor that the arrow keys move. */
import type { ReadonlySignal, Signal } from "@preact/signals";
import { useEffect, useRef, useState } from "preact/hooks";
import { Chart } from "./chart.ts";
import { fixed, significant } from "./format.ts";
import { readPalette, TRACE_COLOURS } from "./palette.ts";
import type { Panel, Trace } from "./panels.ts";
import { drawnWindow, windowAt, type SeriesStore } from "./series.ts";
import type { Session } from "./session.ts";
import { isDark, isOn, switchTo, timeWindow } from "./settings.ts";

type Props = {
  session: Session;
  panel: Panel;
  /** Time pointed at in any panel, null for the latest. */
  cursor: Signal<number | null>;
  tick: ReadonlySignal<number>;
  first: boolean;
  last: boolean;
};

const KEY_STEPS = 100; // arrow keys cross the window in so many steps
const UNIT_DIGITS: Record<string, number> = { m: 3, deg: 2 };

const traceId = (panel: Panel, trace: Trace): string => `${panel.id}/${trace.label}`;
const traceIsOn = (panel: Panel, trace: Trace): boolean => isOn(traceId(panel, trace), trace.shown);

function valueText(value: number, unit: string): string {
  const digits = UNIT_DIGITS[unit];
  return digits === undefined ? significant(value, 4) : fixed(value, digits);
}

export function PlotPanel({ session, panel, cursor, tick, first, last }: Props) {
  const host = useRef<HTMLDivElement>(null);
  const [chart, setChart] = useState<Chart | null>(null);
  const dark = isDark();
  const store = session.series.value;
  const [begin, end] = windowAt(store.lastTime, timeWindow.value);

  useEffect(() => {
    const element = host.current;
    if (!element) return;
    const made = new Chart(element, {
      panel,
      palette: readPalette(),
      timeAxis: last,
      labels: first,
      onPoint: (time) => (cursor.value = time),
    });
    const observer = new ResizeObserver(() => made.resize(element.clientWidth, element.clientHeight));
    observer.observe(element);
    made.resize(element.clientWidth, element.clientHeight);
    setChart(made);
    return () => {
      observer.disconnect();
      made.destroy();
    };
  }, [panel, dark, first, last]);

  const redrawn = tick.value;
  const shownKey = panel.traces.map((trace) => Number(traceIsOn(panel, trace))).join("");
  useEffect(() => {
    if (!chart) return;
    const columns = panel.traces.map(({ column }) => column);
    const drawn = drawnWindow(store, columns, begin, end, Math.max(50, chart.width));
    chart.draw(drawn, begin, end, session.marks.value, panel.traces.map((trace) => traceIsOn(panel, trace)));
    chart.point(cursor.peek());
  }, [chart, store, redrawn, begin, end, shownKey]);
  const pointed = cursor.value;
  useEffect(() => chart?.point(pointed), [chart, pointed]);

  const press = (event: KeyboardEvent): void => {
    const moved = movedCursor(event, cursor.value, begin, Math.min(end, store.lastTime));
    if (moved === undefined) return;
    event.preventDefault();
    cursor.value = moved;
  };
  const row = pointed === null ? store.count - 1 : store.nearestRow(pointed);
  return (
    <article class={last ? "panel last" : "panel"} aria-label={`${panel.title} in ${panel.unit}`}>
      <Legend panel={panel} store={store} row={row} />
      <div
        class="chart"
        tabindex={0}
        role="application"
        aria-roledescription="plot"
        aria-label={`${panel.title} over time. Left and right arrow move the cursor, Escape frees it.`}
        onKeyDown={press}
        onBlur={() => (cursor.value = null)}
      >
        <div class="host" ref={host} aria-hidden="true" />
        <CursorReader panel={panel} store={store} row={pointed === null ? -1 : row} />
      </div>
    </article>
  );
}

/** Where a key moves the cursor; undefined for other keys. */
function movedCursor(event: KeyboardEvent, time: number | null, begin: number, end: number): number | null | undefined {
  const step = ((end - begin) / KEY_STEPS) * (event.shiftKey ? 10 : 1);
  const from = time ?? end;
  switch (event.key) {
    case "ArrowLeft":
      return Math.max(begin, from - step);
    case "ArrowRight":
      return Math.min(end, from + step);
    case "Home":
      return begin;
    case "End":
      return end;
    case "Escape":
      return null;
    default:
      return undefined;
  }
}

type LegendProps = { panel: Panel; store: SeriesStore; row: number };

function Legend({ panel, store, row }: LegendProps) {
  return (
    <div class="legend">
      <h3>
        {panel.title} <span class="unit">{panel.unit}</span>
      </h3>
      <div class="traces">
        {panel.traces.map((trace) => {
          const on = traceIsOn(panel, trace);
          return (
            <button
              key={trace.column}
              type="button"
              class="trace"
              aria-pressed={on}
              title={on ? `Hide ${trace.label}` : `Show ${trace.label}`}
              style={{ "--colour": `var(--trace-${trace.colour % TRACE_COLOURS})` }}
              onClick={() => switchTo(traceId(panel, trace), !on)}
            >
              <span class="swatch" />
              {trace.label}
              {on && <span class="figure">{valueText(store.value(trace.column, row), panel.unit)}</span>}
            </button>
          );
        })}
      </div>
    </div>
  );
}

/** Says the values at the cursor to those who cannot see it. */
function CursorReader({ panel, store, row }: { panel: Panel; store: SeriesStore; row: number }) {
  const focused = useRef<HTMLParagraphElement>(null);
  const mine = focused.current?.parentElement === document.activeElement;
  const words = panel.traces
    .filter((trace) => traceIsOn(panel, trace))
    .map((trace) => `${trace.label} ${valueText(store.value(trace.column, row), panel.unit)} ${panel.unit}`);
  return (
    <p class="unseen" aria-live="polite" ref={focused}>
      {row >= 0 && mine ? `${fixed(store.value(0, row), 2)} seconds: ${words.join(", ")}` : ""}
    </p>
  );
}
