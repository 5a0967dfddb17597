/** The time series as growing columns, the window shown of them, and their CSV. Column 0 is time. */

export class SeriesStore {
  private data: Float64Array[];
  private rows = 0;

  constructor(readonly columns: readonly string[]) {
    this.data = columns.map(() => new Float64Array(1024));
  }

  get count(): number {
    return this.rows;
  }

  get lastTime(): number {
    return this.rows > 0 ? this.value(0, this.rows - 1) : 0;
  }

  /** NaN outside the rows, and where the server had no finite number. */
  value(column: number, row: number): number {
    return row < this.rows ? (this.data[column]?.[row] ?? NaN) : NaN;
  }

  clear(): void {
    this.rows = 0;
  }

  /** @throws RangeError when a row does not have one value per column */
  append(rows: readonly (readonly number[])[]): void {
    for (const row of rows) {
      if (row.length !== this.columns.length)
        throw new RangeError(`a series row has ${row.length} values for ${this.columns.length} columns`);
      if (this.rows === this.data[0]?.length) this.data = this.data.map(doubled);
      for (const [column, values] of this.data.entries()) values[this.rows] = row[column] ?? NaN;
      this.rows++;
    }
  }

  /** First row whose time is not before `time`. */
  rowAt(time: number): number {
    let begin = 0;
    let end = this.rows;
    while (begin < end) {
      const middle = (begin + end) >> 1;
      if (this.value(0, middle) < time) begin = middle + 1;
      else end = middle;
    }
    return begin;
  }

  /** The row closest to `time`, -1 without rows. */
  nearestRow(time: number): number {
    const after = Math.min(this.rowAt(time), this.rows - 1);
    const before = after - 1;
    if (before < 0) return after;
    return time - this.value(0, before) < this.value(0, after) - time ? before : after;
  }
}

function doubled(values: Float64Array): Float64Array {
  const larger = new Float64Array(values.length * 2);
  larger.set(values);
  return larger;
}

/** What uPlot draws: times, then one list per column; null is a gap. */
export type Drawn = [number[], ...(number | null)[][]];

/**
 * The rows of [begin, end] seconds and one on each side, at most two points per bin: where there are
 * more rows than that, each bin keeps its least and largest value in their order, so that no peak is
 * lost however far one looks out.
 */
export function drawnWindow(
  store: SeriesStore,
  columns: readonly number[],
  begin: number,
  end: number,
  bins: number,
): Drawn {
  const first = Math.max(0, store.rowAt(begin) - 1);
  const last = Math.min(store.count, store.rowAt(end) + 1);
  const times: number[] = [];
  const values: (number | null)[][] = columns.map(() => []);
  const rowsPerBin = Math.ceil((last - first) / bins);
  if (rowsPerBin <= 2) {
    for (let row = first; row < last; row++) {
      times.push(store.value(0, row));
      columns.forEach((column, index) => values[index]?.push(gap(store.value(column, row))));
    }
    return [times, ...values];
  }
  // bins begin at multiples of their size, so that the picture does not shimmer while time runs
  for (let row = first - (first % rowsPerBin); row < last; row += rowsPerBin) {
    const from = Math.max(row, first);
    const to = Math.min(row + rowsPerBin, last);
    times.push(store.value(0, from), store.value(0, Math.max(from, to - 1)));
    columns.forEach((column, index) => values[index]?.push(...extremes(store, column, from, to)));
  }
  return [times, ...values];
}

function gap(value: number): number | null {
  return Number.isNaN(value) ? null : value;
}

function extremes(store: SeriesStore, column: number, from: number, to: number): (number | null)[] {
  let least = from;
  let largest = from;
  for (let row = from; row < to; row++) {
    const value = store.value(column, row);
    if (!(value >= store.value(column, least))) least = Number.isNaN(value) ? least : row;
    if (!(value <= store.value(column, largest))) largest = Number.isNaN(value) ? largest : row;
  }
  const [earlier, later] = least < largest ? [least, largest] : [largest, least];
  return [gap(store.value(column, earlier)), gap(store.value(column, later))];
}

/** The whole history as CSV: the columns and units of series.csv, empty where there is no number. */
export function csv(store: SeriesStore): string {
  const lines = [store.columns.join(",")];
  for (let row = 0; row < store.count; row++)
    lines.push(store.columns.map((_, column) => gap(store.value(column, row)) ?? "").join(","));
  return `${lines.join("\n")}\n`;
}

/** The window on the time axis [s]: it scrolls once it is full. */
export function windowAt(lastTime: number, seconds: number): [number, number] {
  if (seconds === 0) return [0, Math.max(lastTime, 1)];
  const end = Math.max(lastTime, seconds);
  return [end - seconds, end];
}
