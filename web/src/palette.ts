/** Colours of traces and axes, read from the style sheet so that there is one place for them. */
export const TRACE_COLOURS = 8;

export type Palette = { trace: string[]; text: string; grid: string };

export function readPalette(): Palette {
  const style = getComputedStyle(document.documentElement);
  const colour = (name: string): string => style.getPropertyValue(name).trim();
  return {
    trace: Array.from({ length: TRACE_COLOURS }, (_, index) => colour(`--trace-${index}`)),
    text: colour("--muted"),
    grid: colour("--grid"),
  };
}
