/** What the page remembers between visits: theme, picture quality, time window, panels. */
import { effect, signal, type Signal } from "@preact/signals";

const PREFIX = "fairlead.";

/** A signal kept in the browser's storage; a value that `valid` refuses is forgotten. */
function remembered<T>(key: string, initial: T, valid: (value: unknown) => value is T): Signal<T> {
  const setting = signal(read(key, initial, valid));
  effect(() => {
    try {
      localStorage.setItem(PREFIX + key, JSON.stringify(setting.value));
    } catch {
      // storage may be forbidden: then nothing is remembered
    }
  });
  return setting;
}

function read<T>(key: string, initial: T, valid: (value: unknown) => value is T): T {
  try {
    const value: unknown = JSON.parse(localStorage.getItem(PREFIX + key) ?? "null");
    return valid(value) ? value : initial;
  } catch {
    return initial;
  }
}

function among<const T>(choices: readonly T[]): (value: unknown) => value is T {
  return (value): value is T => choices.some((choice) => choice === value);
}

function isRecordOfFlags(value: unknown): value is Record<string, boolean> {
  return typeof value === "object" && value !== null && Object.values(value).every((entry) => typeof entry === "boolean");
}

export const THEMES = ["system", "light", "dark"] as const;
export type Theme = (typeof THEMES)[number];
export const theme = remembered<Theme>("theme", "system", among(THEMES));

/** Largest size of the live picture asked for [pixel]. */
export const QUALITIES = {
  light: { label: "640 × 360", width: 640, height: 360 },
  standard: { label: "960 × 540", width: 960, height: 540 },
  sharp: { label: "1600 × 900", width: 1600, height: 900 },
} as const;
export type Quality = keyof typeof QUALITIES;
export const quality = remembered<Quality>("quality", "standard", (value): value is Quality =>
  typeof value === "string" && Object.hasOwn(QUALITIES, value),
);

/** Seconds of the plots' time axis; 0 is all. */
export const WINDOWS = [10, 30, 60, 0] as const;
export type TimeWindow = (typeof WINDOWS)[number];
export const timeWindow = remembered<TimeWindow>("window", 30, among(WINDOWS));

/** Panels and traces that were switched on or off by hand, by id. */
export const switched = remembered<Record<string, boolean>>("switched", {}, isRecordOfFlags);

/** Whether a panel or trace is on: as switched by hand, else as it begins. */
export function isOn(id: string, initially: boolean): boolean {
  return switched.value[id] ?? initially;
}

export function switchTo(id: string, on: boolean): void {
  switched.value = { ...switched.value, [id]: on };
}

const systemDark = matchMedia("(prefers-color-scheme: dark)");
const systemIsDark = signal(systemDark.matches);
systemDark.addEventListener("change", () => (systemIsDark.value = systemDark.matches));

export function isDark(): boolean {
  return theme.value === "dark" || (theme.value === "system" && systemIsDark.value);
}
