/** Headings as the dial draws them: plan view, +x to the right, +y up, angles counter-clockwise. */

export type Range = readonly [number, number];

/** Direction of travel under a point (right, up) from the dial's centre, in whole steps, in the range if it
 * can be. */
export function headingAt(right: number, up: number, limits: Range, step: number): number {
  const degrees = (Math.atan2(up, right) * 180) / Math.PI;
  return intoRange(Math.round(degrees / step) * step, limits);
}

/** The same direction, turned by whole rounds into the range; else the nearer end of the range. */
export function intoRange(degrees: number, [min, max]: Range): number {
  if (degrees >= min && degrees <= max) return degrees;
  const turned = degrees + 360 * Math.ceil((min - degrees) / 360);
  if (turned <= max) return turned;
  return turned - max <= min + 360 - turned ? max : min;
}

/** One step of a key; a range that is a full round goes on past its ends. */
export function turnedBy(degrees: number, step: number, limits: Range): number {
  const [min, max] = limits;
  const next = degrees + step;
  if (max - min >= 360) return intoRange(next, limits);
  return Math.min(max, Math.max(min, next));
}

/** A point on a circle about the centre, for SVG (y downwards). */
export function onCircle(degrees: number, radius: number): { x: number; y: number } {
  const angle = (degrees * Math.PI) / 180;
  return { x: radius * Math.cos(angle), y: -radius * Math.sin(angle) };
}

/** SVG path of the arc from one heading to another, counter-clockwise; a full round is two halves. */
export function arcPath([from, to]: Range, radius: number): string {
  const point = (degrees: number): string => {
    const { x, y } = onCircle(degrees, radius);
    return `${x.toFixed(2)} ${y.toFixed(2)}`;
  };
  const half = (from + Math.min(to, from + 360)) / 2;
  const arc = (degrees: number): string => `A${radius} ${radius} 0 0 0 ${point(degrees)}`;
  return `M${point(from)}${arc(half)}${arc(Math.min(to, from + 360))}`;
}
