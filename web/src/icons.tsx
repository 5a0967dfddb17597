/** Line icons, 16 x 16, drawn in the text's colour. */
const PATHS = {
  start: "M5 3.2v9.6L12.6 8z",
  pause: "M5 3v10M11 3v10",
  reset: "M3.2 8a4.8 4.8 0 1 0 1.5-3.5M4.4 1.6v3.2h3.2",
  camera: "M2 5h3l1.2-2h3.6L11 5h3v8H2zM8 11.2a2.4 2.4 0 1 0 0-4.8 2.4 2.4 0 0 0 0 4.8z",
  plus: "M8 3v10M3 8h10",
  minus: "M3 8h10",
  home: "M2.5 8 8 3l5.5 5M4 7v6h8V7",
  download: "M8 2v8M4.6 6.8 8 10.2l3.4-3.4M3 13.5h10",
  info: "M8 7.2v4.3M8 4.4v.4M8 14.4A6.4 6.4 0 1 0 8 1.6a6.4 6.4 0 0 0 0 12.8z",
  sun: "M8 11a3 3 0 1 0 0-6 3 3 0 0 0 0 6zM8 1.2v1.6M8 13.2v1.6M1.2 8h1.6M13.2 8h1.6M3.2 3.2l1.1 1.1M11.7 11.7l1.1 1.1M3.2 12.8l1.1-1.1M11.7 4.3l1.1-1.1",
  moon: "M13.4 9.6A5.8 5.8 0 0 1 6.4 2.6a5.8 5.8 0 1 0 7 7z",
  close: "M4 4l8 8M12 4l-8 8",
} as const;

export type IconName = keyof typeof PATHS;

export function Icon({ name }: { name: IconName }) {
  return (
    <svg class="icon" viewBox="0 0 16 16" width="16" height="16" aria-hidden="true">
      <path d={PATHS[name]} class={name === "start" ? "filled" : undefined} />
    </svg>
  );
}
