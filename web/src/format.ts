/** Numbers as an engineer reads them. A number that is not finite is a dash. */

const NONE = "–";

/** Fixed digits after the point; the minus is typographic, so that columns of figures line up. */
export function fixed(value: number, digits: number): string {
  if (!Number.isFinite(value)) return NONE;
  const shown = value.toFixed(digits);
  const zero = Number(shown) === 0;
  return zero ? shown.replace("-", "") : shown.replace("-", "−");
}

/** About three significant digits, without exponents between 0.001 and a million. */
export function significant(value: number, digits = 3): string {
  if (!Number.isFinite(value)) return NONE;
  if (value === 0) return "0";
  const magnitude = Math.floor(Math.log10(Math.abs(value)));
  if (magnitude < -3 || magnitude >= 6) return value.toExponential(digits - 1).replace("-", "−");
  return fixed(value, Math.max(0, digits - 1 - magnitude));
}

/** Digits after the point that an axis needs whose ticks are so far apart: 2.5 → 1. */
export function digitsOfStep(step: number): number {
  if (!(step > 0)) return 0;
  const first = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const scaled = step * 10 ** first;
  return Math.abs(scaled - Math.round(scaled)) < 1e-6 * scaled ? first : first + 1;
}

/** Without the dust of a unit's conversion: 180.00000000000003 → 180. */
export function dusted(value: number): number {
  return Number(value.toFixed(6));
}

const THIN_SPACE = "\u2009";

/** 48213 → "48 213" with thin spaces. */
export function grouped(value: number): string {
  if (!Number.isFinite(value)) return NONE;
  return String(Math.round(value)).replace(/\B(?=(\d{3})+$)/g, THIN_SPACE);
}

/** A time step in the unit that suits it: "0.32 ms". */
export function shortTime(seconds: number): string {
  if (!Number.isFinite(seconds) || seconds <= 0) return NONE;
  if (seconds < 1e-3) return `${significant(seconds * 1e6)} µs`;
  if (seconds < 1) return `${significant(seconds * 1e3)} ms`;
  return `${significant(seconds)} s`;
}

export function bytes(count: number): string {
  if (!Number.isFinite(count)) return NONE;
  if (count < 1000) return `${count} B`;
  if (count < 1e6) return `${significant(count / 1e3)} kB`;
  if (count < 1e9) return `${significant(count / 1e6)} MB`;
  return `${significant(count / 1e9)} GB`;
}

export function percent(fraction: number, digits = 1): string {
  return Number.isFinite(fraction) ? `${fixed(fraction * 100, digits)}${THIN_SPACE}%` : NONE;
}

/** "artificial_viscosity" → "Artificial viscosity". */
export function title(name: string): string {
  const words = name.replaceAll("_", " ");
  return words.charAt(0).toUpperCase() + words.slice(1);
}
