import assert from "node:assert/strict";
import { test } from "node:test";
import { bytes, digitsOfStep, dusted, fixed, grouped, percent, shortTime, significant, title } from "./format.ts";

test("fixed digits never show a minus zero", () => {
  assert.equal(fixed(-0.0001, 2), "0.00");
  assert.equal(fixed(-1.5, 1), "−1.5");
  assert.equal(fixed(NaN, 2), "–");
});

test("significant digits suit the magnitude", () => {
  assert.equal(significant(4123.4), "4123");
  assert.equal(significant(0.01234), "0.0123");
  assert.equal(significant(1.2e-7), "1.20e−7");
});

test("an axis has as many digits as its ticks need", () => {
  assert.deepEqual([100, 5, 2.5, 0.5, 0.25, 0.1, 0.02, 0].map(digitsOfStep), [0, 0, 1, 1, 2, 1, 2, 0]);
});

test("dust of a conversion is taken off, not-a-number stays", () => {
  assert.equal(dusted(180.00000000000003), 180);
  assert.equal(dusted(NaN), NaN);
});

test("counts, times, bytes and shares are readable", () => {
  assert.equal(grouped(1234567), "1\u2009234\u2009567");
  assert.equal(shortTime(3.21e-4), "321 µs");
  assert.equal(shortTime(0.0321), "32.1 ms");
  assert.equal(bytes(12_300_000), "12.3 MB");
  assert.equal(percent(0.0123), "1.2\u2009%");
  assert.equal(title("wave_ring"), "Wave ring");
});
