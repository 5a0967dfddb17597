import assert from "node:assert/strict";
import { test } from "node:test";
import { panelsOf } from "./panels.ts";

const BODY = ["surge_m", "sway_m", "heave_m", "roll_deg", "pitch_deg", "yaw_deg"];
const LOAD = ["fluid_fx_n", "fluid_fy_n", "fluid_fz_n", "fluid_mx_nm", "fluid_my_nm", "fluid_mz_nm"];
const LINE = ["fairlead_tension_n", "anchor_tension_n", "largest_tension_n", "touchdown_m"];
const of = (owner: string, names: string[]) => names.map((name) => `${owner}.${name}`);
const SHIP = ["t_s", ...of("ship", [...BODY, ...LOAD]), ...of("bow_line", LINE), "g1.elevation_m"];

test("a moored ship has panels for motions, tension, elevation and force", () => {
  const shown = panelsOf(SHIP).filter((panel) => panel.shown);
  assert.deepEqual(
    shown.map(({ title, unit }) => `${title} [${unit}]`),
    ["Motion [m]", "Rotation [deg]", "Line tension [N]", "Wave elevation [m]", "Water force [N]", "Line on the bed [m]"],
  );
  assert.deepEqual(shown[0]!.traces.map(({ label }) => label), ["surge", "sway", "heave"]);
  assert.deepEqual(shown[2]!.traces.map(({ label, shown: first }) => [label, first]), [
    ["fairlead", true],
    ["anchor", true],
    ["largest", false],
  ]);
  assert.deepEqual(shown[4]!.traces[0], { column: SHIP.indexOf("ship.fluid_fz_n"), label: "vertical", colour: 0, shown: true });
});

test("every column but the time is in exactly one panel, known or not", () => {
  const columns = [...SHIP, "p1.pressure_pa", "hull.wetness_kg", "clock_s"];
  const seen = panelsOf(columns).flatMap(({ traces }) => traces.map(({ column }) => column));
  assert.deepEqual(seen.sort((a, b) => a - b), columns.map((_, index) => index).slice(1));
});

test("two bodies have panels of their own, two lines share one and are named", () => {
  const columns = ["t_s", ...of("barge", BODY), ...of("work_boat", BODY), ...of("fore", LINE), ...of("aft", LINE)];
  const panels = panelsOf(columns);
  assert.deepEqual(panels.slice(0, 2).map(({ title }) => title), ["Motion, barge", "Motion, work boat"]);
  const tension = panels.find(({ id }) => id === "tension")!;
  assert.deepEqual(tension.traces.slice(0, 2).map(({ label }) => label), ["fore fairlead", "aft fairlead"]);
});

test("a still tank with a gauge only has one panel", () => {
  const panels = panelsOf(["t_s", "middle.elevation_m"]);
  assert.equal(panels.length, 1);
  assert.equal(panels[0]!.traces[0]!.label, "middle");
});

test("energies share one panel in joule", () => {
  const panels = panelsOf(["t_s", "energy.kinetic_j", "energy.potential_j", "energy.bodies_j"]);
  assert.deepEqual(panels.map(({ title, unit }) => `${title} [${unit}]`), ["Energy [J]"]);
  assert.deepEqual(panels[0]!.traces.map(({ label }) => label), ["kinetic", "potential", "bodies"]);
});
