// Sums over sampled curves. Curves are pairs of equally long lists with rising x.

/// Value of a curve at x, linear between samples; NaN outside.
export function at(xs, ys, x) {
  if (!(x >= xs[0] && x <= xs[xs.length - 1])) return NaN;
  let low = 0, high = xs.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (xs[middle] <= x) low = middle;
    else high = middle;
  }
  const span = xs[high] - xs[low];
  return span > 0 ? ys[low] + (ys[high] - ys[low]) * (x - xs[low]) / span : ys[low];
}

export const mean = (values) => values.reduce((sum, v) => sum + v, 0) / values.length;
export const rms = (values) => Math.sqrt(mean(values.map((v) => v * v)));
export const largest = (values) => values.reduce((best, v) => Math.max(best, v), -Infinity);
export const smallest = (values) => values.reduce((best, v) => Math.min(best, v), Infinity);

/// The samples of y with from <= x < to.
export const window = (xs, ys, from, to) => ys.filter((_, i) => xs[i] >= from && xs[i] < to);

/// Integral by trapezes over [from, to).
export function integral(xs, ys, from = -Infinity, to = Infinity) {
  let sum = 0;
  for (let i = 1; i < xs.length; i++)
    if (xs[i - 1] >= from && xs[i] < to) sum += 0.5 * (ys[i] + ys[i - 1]) * (xs[i] - xs[i - 1]);
  return sum;
}

/// Local extremes of y: between crossings of `level` the point farthest from it, refined by a parabola.
/// @return [{ x, y }], in order
export function extremes(xs, ys, level = 0) {
  const found = [];
  let best = -1;
  for (let i = 0; i < xs.length; i++) {
    const crossed = i > 0 && (ys[i] - level) * (ys[i - 1] - level) < 0;
    if (crossed && best >= 0) found.push(best);
    if (crossed || best < 0 || Math.abs(ys[i] - level) > Math.abs(ys[best] - level)) best = i;
  }
  return found.map((i) => {
    if (i === 0 || i === xs.length - 1) return { x: xs[i], y: ys[i] };
    const rise = 0.5 * (ys[i + 1] - ys[i - 1]), bend = ys[i + 1] - 2 * ys[i] + ys[i - 1];
    const shift = bend ? Math.max(-1, Math.min(1, -rise / bend)) : 0;
    return { x: xs[i] + shift * 0.5 * (xs[i + 1] - xs[i - 1]), y: ys[i] + rise * shift + 0.5 * bend * shift * shift };
  });
}

/// Crossings of `level`, upwards only or both ways, by straight lines.
export function crossings(xs, ys, level = 0, upwards = false) {
  const found = [];
  for (let i = 1; i < xs.length; i++) {
    const a = ys[i - 1] - level, b = ys[i] - level;
    if (a < 0 && b >= 0 || !upwards && a >= 0 && b < 0) found.push(xs[i - 1] + (xs[i] - xs[i - 1]) * a / (a - b));
  }
  return found;
}

/// Period of a swing about 0, from its first to its last crossing before `until`.
export function swingPeriod(xs, ys, until = Infinity) {
  const zero = crossings(xs, ys).filter((x) => x < until);
  return 2 * (zero.at(-1) - zero[0]) / (zero.length - 1);
}

/// The first `count` extremes after the start, which is one itself.
export const swingPeaks = (xs, ys, count) => extremes(xs, ys).slice(1, 1 + count).map((p) => p.y);

/// Least squares fit of c0 + c1 x.
export function line(xs, ys) {
  const mx = mean(xs), my = mean(ys);
  const slope = xs.reduce((sum, x, i) => sum + (x - mx) * (ys[i] - my), 0) / xs.reduce((sum, x) => sum + (x - mx) ** 2, 0);
  return [my - slope * mx, slope];
}

/// Solution of m x = b by elimination with pivots; both are overwritten.
export function solve(m, b) {
  const n = b.length;
  for (let k = 0; k < n; k++) {
    let best = k;
    for (let i = k + 1; i < n; i++) if (Math.abs(m[i][k]) > Math.abs(m[best][k])) best = i;
    [m[k], m[best]] = [m[best], m[k]];
    [b[k], b[best]] = [b[best], b[k]];
    for (let i = k + 1; i < n; i++) {
      const factor = m[i][k] / m[k][k];
      for (let j = k; j < n; j++) m[i][j] -= factor * m[k][j];
      b[i] -= factor * b[k];
    }
  }
  for (let k = n - 1; k >= 0; k--) {
    for (let j = k + 1; j < n; j++) b[k] -= m[k][j] * b[j];
    b[k] /= m[k][k];
  }
  return b;
}

/// Least squares fit of a sum of functions: coefficients c of sum c_k f_k(x).
export const fit = (xs, ys, functions) => solve(
  functions.map((f) => functions.map((g) => xs.reduce((sum, x) => sum + f(x) * g(x), 0))),
  functions.map((f) => xs.reduce((sum, x, i) => sum + f(x) * ys[i], 0)));

/// Drift, amplitude and phase of y = mean + drift (x - from) + amplitude cos(2 pi x/period - phase) in [from, to), fitted together:
/// a line alone takes some of the swing for drift.
export function swing(xs, ys, period, from, to) {
  const w = 2 * Math.PI / period;
  const c = fit(window(xs, xs, from, to), window(xs, ys, from, to), [() => 1, (x) => x - from, (x) => Math.cos(w * x), (x) => Math.sin(w * x)]);
  return { drift: c[1], amplitude: Math.hypot(c[2], c[3]), phase: Math.atan2(c[3], c[2]) };
}

/// k of omega^2 = g k tanh kd.
export function waveNumber(period, depth, gravity = 9.81) {
  const omega2 = (2 * Math.PI / period) ** 2;
  let k = omega2 / gravity;
  for (let i = 0; i < 100; i++) {
    const t = Math.tanh(k * depth);
    k -= (gravity * k * t - omega2) / (gravity * (t + k * depth * (1 - t * t)));
  }
  return k;
}
