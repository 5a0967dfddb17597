import assert from "node:assert/strict";
import { test } from "node:test";
import { arcPath, headingAt, intoRange, onCircle, turnedBy } from "./angles.ts";

test("up on the dial is 90 degrees, towards +y", () => {
  assert.equal(headingAt(0, 1, [-180, 180], 1), 90);
  assert.equal(headingAt(0, -1, [0, 360], 1), 270);
  const { x, y } = onCircle(90, 10);
  assert.ok(Math.abs(x) < 1e-9 && y === -10);
});

test("a direction outside the range gives the nearer end", () => {
  assert.equal(intoRange(100, [0, 90]), 90);
  assert.equal(intoRange(-20, [0, 90]), 0);
  assert.equal(intoRange(350, [-45, 45]), -10);
});

test("keys stop at the ends of a part of the round and go on over a whole one", () => {
  assert.equal(turnedBy(88, 10, [0, 90]), 90);
  assert.equal(turnedBy(-178, -10, [-180, 180]), 172);
  assert.equal(turnedBy(355, 10, [0, 360]), 5);
});

test("the arc of a full round closes", () => {
  const path = arcPath([-180, 180], 50);
  assert.match(path, /^M-50\.00 -?0\.00A.* 50\.00 -?0\.00A.* -50\.00 -?0\.00$/);
});
