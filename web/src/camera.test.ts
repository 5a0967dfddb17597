import assert from "node:assert/strict";
import { test } from "node:test";
import { orbit, pan, wrapDegrees, zoom } from "./camera.ts";
import type { Camera } from "./protocol.ts";

const HOME: Camera = { azimuth_deg: 0, elevation_deg: 0, distance_m: 10, target_m: [0, 0, 0] };
const near = (a: number, b: number) => assert.ok(Math.abs(a - b) < 1e-9, `${a} is not ${b}`);

test("orbiting keeps target and distance and never passes the pole", () => {
  const turned = orbit(HOME, 0.5, 3);
  assert.deepEqual(turned.target_m, HOME.target_m);
  assert.equal(turned.distance_m, 10);
  assert.equal(turned.azimuth_deg, -90);
  assert.equal(turned.elevation_deg, 89);
});

test("dragging right from an eye on +x moves the target to -y, dragging down lifts it", () => {
  const moved = pan(HOME, 0.1, 0.2);
  near(moved.target_m[0], 0);
  assert.ok(moved.target_m[1] < 0);
  near(moved.target_m[2], -2 * moved.target_m[1]);
});

test("panning never moves the target along the line of sight", () => {
  const camera = { ...HOME, azimuth_deg: 37, elevation_deg: 22 };
  const moved = pan(camera, 0.3, -0.4).target_m;
  const [azimuth, elevation] = [37, 22].map((degrees) => (degrees * Math.PI) / 180) as [number, number];
  near(
    moved[0] * Math.cos(elevation) * Math.cos(azimuth) +
      moved[1] * Math.cos(elevation) * Math.sin(azimuth) +
      moved[2] * Math.sin(elevation),
    0,
  );
});

test("zoom stays within bounds tied to the first view", () => {
  near(zoom(HOME, 0.5, HOME).distance_m, 5);
  near(zoom(HOME, 1e-9, HOME).distance_m, 0.2);
  near(zoom(HOME, 1e9, HOME).distance_m, 200);
});

test("angles wrap into (-180, 180]", () => {
  assert.equal(wrapDegrees(190), -170);
  assert.equal(wrapDegrees(-180), 180);
  assert.equal(wrapDegrees(720), 0);
});
