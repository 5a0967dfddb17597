/** Mooring lines: tension and length of one, its winch, and cutting it. */
import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { Dialog } from "./dialog.tsx";
import { fixed, significant } from "./format.ts";
import { CUT_PLACES, type CutPlace, type LineStatus, type Winch } from "./protocol.ts";
import type { Session } from "./session.ts";

const readable = (name: string): string => name.replaceAll("_", " ");

export function LineBar({ session }: { session: Session }) {
  const chosen = useSignal(0);
  const hello = session.hello.value;
  const names = hello?.lines ?? [];
  if (!hello || names.length === 0) return null;
  const index = Math.min(chosen.value, names.length - 1);
  const name = names[index] ?? "";
  const status = session.status.value?.lines[index];
  const disabled = !session.connected.value;
  return (
    <section class="card line-bar" aria-label="Mooring lines">
      {names.length === 1 ? (
        <h2>{readable(name)}</h2>
      ) : (
        <select aria-label="Line" value={String(index)} onChange={(event) => (chosen.value = event.currentTarget.selectedIndex)}>
          {names.map((each, at) => (
            <option key={each} value={String(at)}>
              {readable(each)}
            </option>
          ))}
        </select>
      )}
      <Figures session={session} name={name} status={status} />
      <WinchField key={name} session={session} name={name} status={status} winch={hello.winches[index] ?? null} disabled={disabled} />
      <CutButton session={session} name={name} disabled={disabled || !status || status.parted} />
    </section>
  );
}

type FiguresProps = { session: Session; name: string; status: LineStatus | undefined };

function Figures({ session, name, status }: FiguresProps) {
  void session.rowsSeen.value;
  const store = session.series.value;
  const now = store.value(store.columns.indexOf(`${name}.fairlead_tension_n`), store.count - 1);
  return (
    <p class="figures">
      <span>
        now <b>{significant(now)}</b> N
      </span>
      <span>
        largest <b>{significant(status?.largest_n ?? NaN)}</b> N
      </span>
      <span>
        length <b>{fixed(status?.length_m ?? NaN, 2)}</b> m
      </span>
      {status?.parted && <span class="chip parted">parted</span>}
    </p>
  );
}

type WinchProps = { session: Session; name: string; status: LineStatus | undefined; winch: Winch | null; disabled: boolean };

function WinchField({ session, name, status, winch, disabled }: WinchProps) {
  const field = useRef<HTMLInputElement>(null);
  const typing = useRef(false);
  const asked = Number.isFinite(status?.asked_m) ? status?.asked_m : status?.length_m;
  const shown = asked === undefined ? "" : asked.toFixed(2);
  // what is being typed must not be overwritten by the next status
  useEffect(() => {
    if (field.current && !typing.current) field.current.value = shown;
  });
  if (!winch) return <p class="empty">no winch</p>;
  const [min, max] = winch.length_m;
  const commit = (): void => {
    const value = field.current?.valueAsNumber ?? NaN;
    typing.current = false;
    if (value >= min && value <= max) return session.orderLine(name, { length_m: value });
    session.notify("bad", `Length must be ${min} to ${max} m; kept ${shown}.`);
    if (field.current) field.current.value = shown;
  };
  return (
    <p class="winch">
      <label for="line-length">
        Winch to <span class="unit">m</span>
      </label>
      <input
        ref={field}
        id="line-length"
        type="number"
        inputMode="decimal"
        min={min}
        max={max}
        step="any"
        title={`${min} to ${max} m, at most ${winch.speed_ms} m/s`}
        disabled={disabled || (status?.parted ?? true)}
        onInput={() => (typing.current = true)}
        onChange={commit}
      />
      <span class="limits">
        {min} to {max}
      </span>
    </p>
  );
}

const PLACE_NAMES: Record<CutPlace, string> = { anchor: "At the anchor", middle: "In the middle", fairlead: "At the fairlead" };

function CutButton({ session, name, disabled }: { session: Session; name: string; disabled: boolean }) {
  const asking = useSignal(false);
  const cut = (place: CutPlace): void => {
    asking.value = false;
    session.orderLine(name, { cut: place });
  };
  return (
    <>
      <button type="button" disabled={disabled} onClick={() => (asking.value = true)}>
        Cut…
      </button>
      <Dialog title={`Cut ${readable(name)}?`} open={asking.value} onClose={() => (asking.value = false)}>
        <p>The line parts at once and for good, for everybody who watches. A reset makes it whole.</p>
        <div class="answers">
          <button type="button" onClick={() => (asking.value = false)}>
            Leave it
          </button>
          {CUT_PLACES.map((place) => (
            <button key={place} type="button" class={place === "fairlead" ? "primary" : ""} onClick={() => cut(place)}>
              {PLACE_NAMES[place]}
            </button>
          ))}
        </div>
      </Dialog>
    </>
  );
}
