/** Top bar: which case this is, start, pause, reset, what the run is made of, theme. */
import { useSignal } from "@preact/signals";
import { AboutDialog } from "./about_dialog.tsx";
import { Dialog } from "./dialog.tsx";
import { Icon } from "./icons.tsx";
import type { Session } from "./session.ts";
import { isDark, theme } from "./settings.ts";

export function Header({ session }: { session: Session }) {
  const about = useSignal(false);
  const hello = session.hello.value;
  const warnings = hello?.warnings.length ?? 0;
  return (
    <header class="bar">
      <div class="brand">
        <svg viewBox="0 0 24 24" width="24" height="24" aria-hidden="true">
          <path d="M2 14.5h20l-3 5H6z" class="hull" />
          <path d="M6 14.5 12 3l6 11.5" class="rig" />
        </svg>
        <h1>Fairlead</h1>
      </div>
      <p class="case" title={hello?.case.title}>
        {hello?.case.title ?? "Waiting for the server"}
      </p>
      <RunButtons session={session} />
      <button
        type="button"
        class={warnings > 0 ? "warned" : "quiet"}
        disabled={!hello}
        onClick={() => (about.value = true)}
      >
        <Icon name="info" />
        <span>{warnings > 0 ? `${warnings} warning${warnings > 1 ? "s" : ""}` : "About"}</span>
      </button>
      <ThemeButton />
      {hello && <AboutDialog hello={hello} open={about.value} onClose={() => (about.value = false)} />}
    </header>
  );
}

function RunButtons({ session }: { session: Session }) {
  const asking = useSignal(false);
  const state = session.status.value?.state;
  const connected = session.connected.value;
  const running = state === "running";
  const reset = (): void => {
    asking.value = false;
    session.run("reset");
  };
  return (
    <div class="run" role="group" aria-label="Run">
      <button
        type="button"
        class="primary"
        disabled={!connected || state === "failed"}
        onClick={() => session.run(running ? "pause" : "start")}
      >
        <Icon name={running ? "pause" : "start"} />
        <span>{running ? "Pause" : "Start"}</span>
      </button>
      <button type="button" disabled={!connected} onClick={() => (asking.value = true)}>
        <Icon name="reset" />
        <span>Reset</span>
      </button>
      <Dialog title="Begin anew at t = 0?" open={asking.value} onClose={() => (asking.value = false)}>
        <p>The state and the plotted series are lost for everybody who watches. The journal keeps the run.</p>
        <div class="answers">
          <button type="button" onClick={() => (asking.value = false)}>
            Keep running
          </button>
          <button type="button" class="primary" onClick={reset}>
            Reset
          </button>
        </div>
      </Dialog>
    </div>
  );
}

function ThemeButton() {
  const dark = isDark();
  const label = dark ? "Light colours" : "Dark colours";
  return (
    <button
      type="button"
      class="quiet square"
      aria-label={label}
      title={label}
      onClick={() => (theme.value = dark ? "light" : "dark")}
    >
      <Icon name={dark ? "sun" : "moon"} />
    </button>
  );
}
