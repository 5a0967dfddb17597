/** The sea: height, period and heading. What is asked acts at once; what is now stands beside it. */
import { useEffect, useRef } from "preact/hooks";
import { Dial } from "./dial.tsx";
import { dusted, fixed, significant } from "./format.ts";
import type { Current, Limits, WaveKey } from "./protocol.ts";
import type { Session } from "./session.ts";

type Quantity = { key: WaveKey; label: string; unit: string; digits: number; step: number };

const QUANTITIES: readonly Quantity[] = [
  { key: "height_m", label: "Height", unit: "m", digits: 3, step: 0.01 },
  { key: "period_s", label: "Period", unit: "s", digits: 2, step: 0.05 },
  { key: "heading_deg", label: "Heading", unit: "°", digits: 0, step: 1 },
];

export function WaveCard({ session }: { session: Session }) {
  const limits = session.hello.value?.limits;
  const current = session.hello.value?.current ?? null;
  const changing = session.status.value?.wave?.changing ?? false;
  const disabled = !session.connected.value;
  return (
    <section class="card wave" id="controls" tabindex={-1} aria-labelledby="wave-title">
      <h2 id="wave-title">
        Waves
        {limits && <span class={`chip ${changing ? "active" : ""}`}>{changing ? "changing" : "as asked"}</span>}
      </h2>
      {limits ? (
        <fieldset disabled={disabled}>
          <legend class="unseen">Sea asked for</legend>
          <div class="dial-cell">
            <Dial
              asked={session.asked.value.heading_deg}
              now={session.now.value.heading_deg}
              limits={limits.heading_deg}
              current={current ? current.heading_deg : NaN}
              disabled={disabled}
              onTurn={(heading_deg) => session.setWave({ heading_deg })}
            />
            <p class="key" aria-hidden="true">
              <span class="asked">asked</span>
              <span class="now">now</span>
            </p>
          </div>
          <div class="quantities">
            {QUANTITIES.map((quantity) => (
              <QuantityRow key={quantity.key} session={session} quantity={quantity} limits={limits} />
            ))}
            {current && <CurrentLine current={current} />}
          </div>
        </fieldset>
      ) : (
        <p class="empty">{session.hello.value ? "This case has no waves that can be steered." : "–"}</p>
      )}
      {current && !limits && <CurrentLine current={current} />}
    </section>
  );
}

function CurrentLine({ current }: { current: Current }) {
  return (
    <p class="current">
      Current {significant(current.speed_ms, 3)} m/s to {fixed(current.heading_deg, 0)}°
    </p>
  );
}

type RowProps = { session: Session; quantity: Quantity; limits: Limits };

function QuantityRow({ session, quantity, limits }: RowProps) {
  const { key, label, unit, digits, step } = quantity;
  const field = useRef<HTMLInputElement>(null);
  const [min, max] = limits[key];
  const asked = session.asked.value[key];
  const now = session.now.value[key];
  const shown = Number.isFinite(asked) ? asked.toFixed(digits) : "";
  const set = (value: number): void => session.setWave({ [key]: value });
  // what is being typed must not be overwritten by the next status
  const typing = useRef(false);
  useEffect(() => {
    if (field.current && !typing.current) field.current.value = shown;
  });
  const commit = (): void => {
    const input = field.current;
    if (!input) return;
    typing.current = false;
    const value = input.valueAsNumber;
    if (value >= min && value <= max) return set(value);
    session.notify("bad", `${label} must be ${fixed(min, digits)} to ${fixed(max, digits)} ${unit}; kept ${shown}.`);
    input.value = shown;
  };
  /** Arrow keys step by a round amount: the browser's own steps start at an unround least value. */
  const stepByKeys = (event: KeyboardEvent): void => {
    const direction = event.key === "ArrowUp" ? 1 : event.key === "ArrowDown" ? -1 : 0;
    const value = field.current?.valueAsNumber ?? NaN;
    if (direction === 0 || !Number.isFinite(value)) return;
    event.preventDefault();
    typing.current = false;
    set(roundedWithin(value + direction * step, step, min, max));
  };
  return (
    <div class="quantity">
      <label for={`field-${key}`}>
        {label} <span class="unit">{unit}</span>
      </label>
      <input
        ref={field}
        id={`field-${key}`}
        type="number"
        inputMode="decimal"
        min={min}
        max={max}
        step="any"
        aria-describedby={`now-${key}`}
        onInput={() => (typing.current = true)}
        onChange={commit}
        onKeyDown={stepByKeys}
      />
      <output id={`now-${key}`} class="now" aria-live="off">
        now {fixed(now, digits)}
      </output>
      {key === "heading_deg" ? (
        <p class="limits">
          {fixed(min, 0)} to {fixed(max, 0)}
        </p>
      ) : (
        <Slider label={label} min={min} max={max} step={step / 2} value={asked} onSlide={set} />
      )}
    </div>
  );
}

function roundedWithin(value: number, step: number, min: number, max: number): number {
  const rounded = Math.round(value / step) * step;
  return dusted(Math.min(max, Math.max(min, rounded)));
}

const KEY_DIRECTIONS: Readonly<Record<string, number>> = { ArrowUp: 1, ArrowRight: 1, ArrowDown: -1, ArrowLeft: -1 };

type SliderProps = {
  label: string;
  min: number;
  max: number;
  step: number;
  value: number;
  onSlide: (value: number) => void;
};

function Slider({ label, min, max, step, value, onSlide }: SliderProps) {
  const slide = (event: Event): void => {
    if (!(event.currentTarget instanceof HTMLInputElement)) return;
    onSlide(roundedWithin(event.currentTarget.valueAsNumber, step, min, max));
  };
  const slideByKeys = (event: KeyboardEvent): void => {
    const direction = KEY_DIRECTIONS[event.key];
    if (direction === undefined || !Number.isFinite(value)) return;
    event.preventDefault();
    onSlide(roundedWithin(value + direction * step, step, min, max));
  };
  return (
    <div class="slider">
      <span aria-hidden="true">{dusted(min)}</span>
      <input
        type="range"
        min={min}
        max={max}
        step="any"
        value={Number.isFinite(value) ? value : min}
        aria-label={`${label} slider`}
        onInput={slide}
        onKeyDown={slideByKeys}
      />
      <span aria-hidden="true">{dusted(max)}</span>
    </div>
  );
}
