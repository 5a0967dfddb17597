/** Orbit camera arithmetic: pure functions from a camera and a gesture to a camera. */
import type { Camera } from "./protocol.ts";

/** Vertical field of view assumed when a drag is turned into metres [rad]. */
const FIELD_OF_VIEW = (40 * Math.PI) / 180;
const ELEVATION_LIMIT_DEG = 89;
const DEGREES_PER_PICTURE = 180; // a drag over the picture's height turns by this much

const radians = (degrees: number): number => (degrees * Math.PI) / 180;
const clamp = (value: number, min: number, max: number): number => Math.min(max, Math.max(min, value));

/** Into (-180, 180]. */
export function wrapDegrees(degrees: number): number {
  const wrapped = ((degrees % 360) + 360) % 360;
  return wrapped > 180 ? wrapped - 360 : wrapped;
}

/** Turn by a drag of (right, down) in fractions of the picture's height; the scene follows the hand. */
export function orbit(camera: Camera, right: number, down: number): Camera {
  return {
    ...camera,
    azimuth_deg: wrapDegrees(camera.azimuth_deg - right * DEGREES_PER_PICTURE),
    elevation_deg: clamp(
      camera.elevation_deg + down * DEGREES_PER_PICTURE,
      -ELEVATION_LIMIT_DEG,
      ELEVATION_LIMIT_DEG,
    ),
  };
}

/** Shift the target so that the point under the hand follows it; fractions of the picture's height. */
export function pan(camera: Camera, right: number, down: number): Camera {
  const azimuth = radians(camera.azimuth_deg);
  const elevation = radians(camera.elevation_deg);
  const metres = 2 * camera.distance_m * Math.tan(FIELD_OF_VIEW / 2);
  // screen axes of an eye at (azimuth, elevation) looking at the target
  const screenRight = [-Math.sin(azimuth), Math.cos(azimuth), 0] as const;
  const screenUp = [
    -Math.sin(elevation) * Math.cos(azimuth),
    -Math.sin(elevation) * Math.sin(azimuth),
    Math.cos(elevation),
  ] as const;
  const moved = (axis: 0 | 1 | 2): number =>
    camera.target_m[axis] + metres * (down * screenUp[axis] - right * screenRight[axis]);
  return { ...camera, target_m: [moved(0), moved(1), moved(2)] };
}

/** Move the eye towards (factor < 1) or away from the target, within 1/50 to 20 times `home`. */
export function zoom(camera: Camera, factor: number, home: Camera): Camera {
  return {
    ...camera,
    distance_m: clamp(camera.distance_m * factor, home.distance_m / 50, home.distance_m * 20),
  };
}
