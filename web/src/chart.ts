/** One uPlot chart of a panel: axes, value range, marks of changes as elements over the plot. */
import uPlot from "uplot";
import { digitsOfStep, fixed, significant } from "./format.ts";
import { groupMarks, type Mark, type Place, placeLabels } from "./markers.ts";
import type { Palette } from "./palette.ts";
import type { Panel } from "./panels.ts";
import type { Drawn } from "./series.ts";

const FONT = "11px system-ui, sans-serif";
const VALUE_AXIS_PX = 52;
const TIME_AXIS_PX = 24;
const LEAST_MARK_DISTANCE_PX = 14;
const LABEL_ROWS = 2;
/** Of the widest figures and letters in the marks' font; a little too much is better than too little. */
const LABEL_CHARACTER_PX = 6.5;
const LABEL_MARGIN_PX = 12;
const LABEL_MOST_PX = 184; // plots.css cuts them at 176

export type ChartOptions = {
  panel: Panel;
  palette: Palette;
  /** whether times are written under it */
  timeAxis: boolean;
  /** whether the marks carry their text */
  labels: boolean;
  /** time under the pointer, null when it has left */
  onPoint: (time: number | null) => void;
};

/** The value axis: what is drawn and a tenth more, never less than the panel's least span. */
function valueRange(leastSpan: number): uPlot.Range.Function {
  return (_chart, min, max) => {
    if (!Number.isFinite(min) || !Number.isFinite(max)) return [-leastSpan / 2, leastSpan / 2];
    const middle = (min + max) / 2;
    const half = Math.max((max - min) * 0.55, leastSpan / 2);
    return [middle - half, middle + half];
  };
}

export class Chart {
  private readonly plot: uPlot;
  private range: [number, number] = [0, 1];
  private marks: readonly Mark[] = [];
  private readonly markLayer = document.createElement("div");

  constructor(
    host: HTMLElement,
    private readonly options: ChartOptions,
  ) {
    this.markLayer.className = "marks";
    this.plot = new uPlot(this.plotOptions(), [[], ...options.panel.traces.map(() => [])], host);
    this.plot.over.append(this.markLayer);
    this.plot.over.addEventListener("pointerdown", this.touch);
    this.plot.over.addEventListener("pointermove", this.touch);
  }

  resize(width: number, height: number): void {
    this.plot.setSize({ width, height });
  }

  /** Draws a window of the series; `shown` tells for each trace whether it is drawn. */
  draw(drawn: Drawn, begin: number, end: number, marks: readonly Mark[], shown: readonly boolean[]): void {
    this.range = [begin, end];
    this.marks = marks;
    shown.forEach((show, index) => {
      if (this.plot.series[index + 1]?.show !== show) this.plot.setSeries(index + 1, { show }, false);
    });
    this.plot.setData(drawn);
    this.drawMarks();
  }

  /** Puts the cursor at a time, or takes it away. */
  point(time: number | null): void {
    const hidden = time === null || time < this.range[0] || time > this.range[1];
    const left = hidden ? -10 : this.plot.valToPos(time, "x");
    this.plot.setCursor({ left, top: hidden ? -10 : 0 }, false);
  }

  /** Width of the plotting area [pixel]. */
  get width(): number {
    return this.plot.over.clientWidth;
  }

  destroy(): void {
    this.plot.destroy();
  }

  private readonly touch = (event: PointerEvent): void => {
    if (event.pointerType === "mouse") return;
    const left = event.clientX - this.plot.over.getBoundingClientRect().left;
    this.options.onPoint(this.plot.posToVal(left, "x"));
  };

  private plotOptions(): uPlot.Options {
    const { panel, palette, timeAxis } = this.options;
    const axis = { font: FONT, stroke: palette.text, grid: { stroke: palette.grid, width: 1 }, ticks: { show: false } };
    return {
      width: 100,
      height: 100,
      padding: [6, 8, timeAxis ? 0 : 4, 0],
      legend: { show: false },
      cursor: { drag: { setScale: false, x: false, y: false }, y: false, points: { size: 5 } },
      scales: { x: { time: false, range: () => this.range }, y: { range: valueRange(panel.leastSpan) } },
      axes: [
        { ...axis, space: 48, size: timeAxis ? TIME_AXIS_PX : 0, gap: 4, values: timeAxis ? axisValues : () => [] },
        { ...axis, space: 24, size: VALUE_AXIS_PX, gap: 6, values: axisValues },
      ],
      series: [
        {},
        ...panel.traces.map((trace) => ({
          label: trace.label,
          stroke: palette.trace[trace.colour % palette.trace.length] ?? palette.text,
          width: 1.5,
          dash: trace.colour >= palette.trace.length ? [4, 3] : [],
          points: { show: false },
          spanGaps: false,
          pxAlign: 0, // slow curves would climb in steps
        })),
      ],
      hooks: {
        setCursor: [
          (chart) => {
            const left = chart.cursor.left ?? -1;
            this.options.onPoint(left < 0 ? null : chart.posToVal(left, "x"));
          },
        ],
        setSize: [() => this.drawMarks()],
      },
    };
  }

  /** Elements rather than pixels: their text can be selected, read out and tested. */
  private drawMarks(): void {
    const [begin, end] = this.range;
    const width = this.width;
    if (!this.markLayer || width === 0) return;
    const groups = groupMarks(this.marks, ((end - begin) * LEAST_MARK_DISTANCE_PX) / width)
      .filter(({ time_s }) => time_s >= begin && time_s <= end);
    const at = groups.map(({ time_s }) => ((time_s - begin) / (end - begin)) * width);
    const lengths = groups.map(({ label }) => Math.min(label.length * LABEL_CHARACTER_PX + LABEL_MARGIN_PX, LABEL_MOST_PX));
    const places = this.options.labels ? placeLabels(at, lengths, width, LABEL_ROWS) : [];
    this.markLayer.replaceChildren(
      ...groups.map(({ label, detail }, index) => {
        const line = document.createElement("div");
        line.className = "mark";
        line.style.left = `${(100 * (at[index] as number)) / width}%`;
        line.title = detail;
        const place = places[index];
        if (place) line.append(labelOf(label, place));
        return line;
      }),
    );
  }
}

function labelOf(text: string, place: Place): HTMLElement {
  const label = document.createElement("span");
  label.className = place.left ? "label left" : "label";
  label.style.setProperty("--row", String(place.row));
  label.textContent = text;
  return label;
}

function axisValues(_chart: uPlot, splits: number[]): string[] {
  const digits = digitsOfStep(Math.abs((splits[1] ?? 0) - (splits[0] ?? 0)));
  return splits.map((split) => (Math.abs(split) < 1e6 ? fixed(split, digits) : significant(split)));
}
