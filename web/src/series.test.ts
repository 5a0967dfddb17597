import assert from "node:assert/strict";
import { test } from "node:test";
import { csv, drawnWindow, SeriesStore, windowAt } from "./series.ts";

function wave(rows: number): SeriesStore {
  const store = new SeriesStore(["t_s", "a_m"]);
  store.append(Array.from({ length: rows }, (_, row) => [row * 0.01, Math.sin(row * 0.37)]));
  return store;
}

test("rows are kept in order beyond the first allocation", () => {
  const store = wave(5000);
  assert.equal(store.count, 5000);
  assert.equal(store.value(1, 4321), Math.sin(4321 * 0.37));
  assert.ok(Math.abs(store.lastTime - 49.99) < 1e-9);
});

test("a row of the wrong length is refused and nothing is kept of it", () => {
  const store = wave(3);
  assert.throws(() => store.append([[1, 2, 3]]), RangeError);
  assert.equal(store.count, 3);
});

test("rows are found by time", () => {
  const store = wave(100);
  assert.equal(store.rowAt(-1), 0);
  assert.equal(store.rowAt(0.095), 10);
  assert.equal(store.rowAt(99), 100);
  assert.equal(store.nearestRow(0.094), 9);
  assert.equal(store.nearestRow(0.096), 10);
  assert.equal(new SeriesStore(["t_s"]).nearestRow(1), -1);
});

test("a short window is drawn sample by sample, reaching both ends", () => {
  const [times] = drawnWindow(wave(100), [1], 0.2, 0.3, 500);
  assert.ok(times[0]! < 0.2 && times.at(-1)! >= 0.3);
  assert.equal(times.length, 12);
});

test("a long window keeps every peak in few points and in order of time", () => {
  const store = wave(10007);
  store.append([[100.07, 50]]);
  store.append(Array.from({ length: 9992 }, (_, row) => [100.08 + row * 0.01, 0]));
  const [times, values] = drawnWindow(store, [1], 0, 201, 300);
  assert.ok(times.length <= 602, `${times.length} points`);
  assert.ok(values!.includes(50));
  for (let index = 1; index < times.length; index++) assert.ok(times[index]! >= times[index - 1]!);
});

test("a number that is not finite is a gap in the plot and an empty field in the CSV", () => {
  const store = new SeriesStore(["t_s", "a_m"]);
  store.append([[0, 1], [0.5, NaN], [1, 3]]);
  assert.deepEqual(drawnWindow(store, [1], 0, 1, 100)[1], [1, null, 3]);
  assert.equal(csv(store), "t_s,a_m\n0,1\n0.5,\n1,3\n");
});

test("after clear the history begins anew", () => {
  const store = wave(10);
  store.clear();
  assert.equal(store.count, 0);
  assert.equal(csv(store), "t_s,a_m\n");
});

test("the window stands until it is full, then scrolls; all begins at zero", () => {
  assert.deepEqual(windowAt(4, 10), [0, 10]);
  assert.deepEqual(windowAt(25, 10), [15, 25]);
  assert.deepEqual(windowAt(25, 0), [0, 25]);
});
