/** The strip charts: one time axis and one cursor for all panels, marks where something was changed. */
import { effect, signal, useSignal } from "@preact/signals";
import { useEffect, useMemo, useRef } from "preact/hooks";
import { saveFile } from "./download.ts";
import { fixed } from "./format.ts";
import { Icon } from "./icons.tsx";
import { panelsOf, type Panel } from "./panels.ts";
import { PlotPanel } from "./plot_panel.tsx";
import { csv } from "./series.ts";
import type { Session } from "./session.ts";
import { isOn, switchTo, timeWindow, WINDOWS } from "./settings.ts";

const REDRAW_MS = 100;

export function Plots({ session }: { session: Session }) {
  const columns = session.series.value.columns;
  const panels = useMemo(() => panelsOf(columns), [columns]);
  const cursor = useSignal<number | null>(null);
  const tick = useRedrawTick(session);
  const shown = panels.filter((panel) => isOn(panel.id, panel.shown));
  return (
    <section class="plots" aria-labelledby="plots-title">
      <div class="plots-head">
        <h2 id="plots-title">
          {cursor.value === null ? "Series" : `At ${fixed(cursor.value, 2)} s`}
        </h2>
        <WindowChoice />
        <PanelChoice panels={panels} />
        <button
          type="button"
          class="quiet"
          disabled={session.rowsSeen.value === 0 || session.series.value.count === 0}
          onClick={() => saveSeries(session)}
        >
          <Icon name="download" />
          <span>CSV</span>
        </button>
      </div>
      <div class="panels">
        {shown.map((panel, index) => (
          <PlotPanel
            key={panel.id}
            session={session}
            panel={panel}
            cursor={cursor}
            tick={tick}
            first={index === 0}
            last={index === shown.length - 1}
          />
        ))}
        {session.hello.value && shown.length === 0 && (
          <p class="empty">{panels.length > 0 ? "All panels are switched off." : "This case has nothing to plot."}</p>
        )}
      </div>
    </section>
  );
}

/** Rows come faster than plots need drawing: counts up at most ten times a second. */
function useRedrawTick(session: Session) {
  const tick = useMemo(() => signal(0), []);
  useEffect(() => {
    let timer: ReturnType<typeof setTimeout> | undefined;
    const stop = effect(() => {
      void [session.rowsSeen.value, session.marks.value];
      timer ??= setTimeout(() => {
        timer = undefined;
        tick.value++;
      }, REDRAW_MS);
    });
    return () => {
      stop();
      clearTimeout(timer);
    };
  }, [session]);
  return tick;
}

function WindowChoice() {
  return (
    <div class="segments" role="group" aria-label="Time window">
      {WINDOWS.map((seconds) => (
        <button
          key={seconds}
          type="button"
          aria-pressed={timeWindow.value === seconds}
          onClick={() => (timeWindow.value = seconds)}
        >
          {seconds === 0 ? "All" : `${seconds} s`}
        </button>
      ))}
    </div>
  );
}

function PanelChoice({ panels }: { panels: readonly Panel[] }) {
  const menu = useRef<HTMLDetailsElement>(null);
  const close = (): void => {
    if (menu.current) menu.current.open = false;
  };
  const leave = (event: FocusEvent): void => {
    if (!(event.relatedTarget instanceof Node && menu.current?.contains(event.relatedTarget))) close();
  };
  return (
    <details class="menu" ref={menu} onFocusOut={leave} onKeyDown={(event) => event.key === "Escape" && close()}>
      <summary>Panels</summary>
      <div class="menu-body" tabindex={-1}>
        {panels.map((panel) => (
          <label key={panel.id}>
            <input
              type="checkbox"
              checked={isOn(panel.id, panel.shown)}
              onChange={(event) => switchTo(panel.id, event.currentTarget.checked)}
            />
            {panel.title} <span class="unit">{panel.unit}</span>
          </label>
        ))}
      </div>
    </details>
  );
}

function saveSeries(session: Session): void {
  const store = session.series.value;
  const name = session.hello.value?.case.name ?? "fairlead";
  saveFile(`${name}_t${store.lastTime.toFixed(2)}s_series.csv`, new Blob([csv(store)], { type: "text/csv" }));
}
