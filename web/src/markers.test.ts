import assert from "node:assert/strict";
import { test } from "node:test";
import { groupMarks } from "./markers.ts";

const at = (time_s: number, text: string) => ({ time_s, text });

test("marks of one drag become one line at the last of them", () => {
  const groups = groupMarks([at(1, "10"), at(1.1, "20"), at(1.3, "30"), at(5, "period")], 0.5);
  assert.deepEqual(groups.map(({ time_s, label }) => [time_s, label]), [[1.3, "30 (+2)"], [5, "period"]]);
  assert.match(groups[0]!.detail, /1\.10 s: 20\n1\.30 s: 30/);
});

test("marks further apart stay single, no marks give no groups", () => {
  assert.equal(groupMarks([at(0, "a"), at(1, "b")], 0.5).length, 2);
  assert.deepEqual(groupMarks([], 1), []);
});
