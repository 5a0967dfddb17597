/** Limits how often values are sent; the first goes at once and the last is certain to go. */

export type Timers = {
  now(): number;
  later(milliseconds: number, call: () => void): unknown;
};

const BROWSER: Timers = {
  now: () => performance.now(),
  later: (milliseconds, call) => setTimeout(call, milliseconds),
};

/**
 * @param interval  least time between two sends [ms]
 * @param merge     joins a waiting value with a newer one; by default the newer replaces it
 */
export function throttle<T>(
  interval: number,
  send: (value: T) => void,
  merge: (waiting: T, newer: T) => T = (_waiting, newer) => newer,
  timers: Timers = BROWSER,
): (value: T) => void {
  let waiting: { value: T } | null = null;
  let armed = false;
  let last = -Infinity;

  const flush = (): void => {
    armed = false;
    if (!waiting) return;
    const { value } = waiting;
    waiting = null;
    last = timers.now();
    send(value);
  };

  return (value) => {
    waiting = { value: waiting ? merge(waiting.value, value) : value };
    if (armed) return;
    const pause = last + interval - timers.now();
    if (pause <= 0) return flush();
    armed = true;
    timers.later(pause, flush);
  };
}
