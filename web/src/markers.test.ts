import assert from "node:assert/strict";
import { test } from "node:test";
import { groupMarks, placeLabels } from "./markers.ts";

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

test("texts of marks never lie upon each other, the newest have room", () => {
  const at = [0, 40, 80, 120, 160, 370], lengths = at.map(() => 90);
  const places = placeLabels(at, lengths, 400, 2);
  assert.deepEqual(places.at(-1), { row: 0, left: true });
  assert.deepEqual(places[4], { row: 0, left: false });
  for (const row of [0, 1]) {
    const spans = places.flatMap((place, i) => (place?.row === row ? [place.left ? at[i]! - 90 : at[i]!] : []));
    for (let i = 1; i < spans.length; i++) assert.ok(spans[i]! - spans[i - 1]! >= 90, `${row}: ${spans.join(", ")}`);
  }
  assert.ok(places.some((place) => place === null), "there is no room for all of them");
});
