// Linear potential flow around a rectangular section that heaves in water of finite depth, by matching eigenfunctions
// under and beside it, and its decay from an offset in time. Sources: Lee (1995), Ocean Eng. 22, 19, for the section;
// Cummins (1962), Schiffstechnik 9, 101, and Ogilvie (1964) for the motion. Checked: added mass and damping satisfy the relation of
// Kramers and Kronig (Ogilvie 1964) to six digits, damping of slow heave is rho g B^2/(2 sqrt(g d)).
import { mean, solve, waveNumber } from './signal.mjs';

export const GRAVITY = 9.81;
const MODES = 40;

/// Roots k_n of omega^2 = -g k tan kd, one in each ((n - 1/2) pi/d, n pi/d).
function evanescent(omega, depth) {
  return Array.from({ length: MODES }, (_, i) => {
    let low = (i + 0.5) * Math.PI / depth, high = (i + 1) * Math.PI / depth;
    for (let k = 0; k < 60; k++) {
      const middle = 0.5 * (low + high);
      if (omega * omega * Math.cos(middle * depth) + GRAVITY * middle * Math.sin(middle * depth) > 0 === (i % 2 === 1)) high = middle;
      else low = middle;
    }
    return 0.5 * (low + high);
  });
}

/// Added mass [kg/m] and damping [kg/(m s)] in heave at omega [rad/s] of a box of half breadth b and draft [m].
/// The potential of unit velocity is (y^2 - x^2)/(2 s) + sum B_m cos(l_m y) cosh(l_m x)/cosh(l_m b) under the box, y from
/// the bed, s the clearance, l_m = m pi/s; sum A_n Z_n(y) exp(-k_n (x - b)) beside it. Velocities are projected on Z_n,
/// potentials on cos(l_m y).
export function heavingBox({ breadth, draft, depth, density = 1000 }, omega) {
  const b = 0.5 * breadth, s = depth - draft;
  const k0 = waveNumber(2 * Math.PI / omega, depth, GRAVITY), ks = evanescent(omega, depth);
  const l = (m) => m * Math.PI / s, flip = (m) => (m % 2 ? -1 : 1), slope = (m) => l(m) * Math.tanh(l(m) * b);
  const norm0 = Math.sqrt(0.5 * (1 + Math.sinh(2 * k0 * depth) / (2 * k0 * depth)));
  const norm = ks.map((k) => Math.sqrt(0.5 * (1 + Math.sin(2 * k * depth) / (2 * k * depth))));
  const c0 = (m) => flip(m) * k0 * Math.sinh(k0 * s) / (k0 * k0 + l(m) ** 2) / norm0;
  const c = (m, n) => flip(m) * ks[n] * Math.sin(ks[n] * s) / (ks[n] ** 2 - l(m) ** 2) / norm[n];
  const table = Array.from({ length: MODES }, (_, m) => ks.map((_, n) => c(m, n)));
  const near = (m, j) => ks.reduce((sum, k, n) => sum - table[m][n] * table[j][n] / (depth * k), 0);
  const far = (m, j) => -c0(m) * c0(j) / (depth * k0); // imaginary: 1/(i k)
  // unknown B_m: real parts, then imaginary parts
  const matrix = Array.from({ length: 2 * MODES }, () => new Array(2 * MODES).fill(0)), right = new Array(2 * MODES);
  for (let m = 0; m < MODES; m++) {
    const particular = m ? flip(m) / l(m) ** 2 : s * s / 6 - b * b / 2;
    right[m] = -near(m, 0) * b / s - particular;
    right[MODES + m] = -far(m, 0) * b / s;
    for (let j = 0; j < MODES; j++) {
      const own = m === j ? s * (m ? 0.5 : 1) : 0, re = near(m, j) * slope(j), im = far(m, j) * slope(j);
      matrix[m][j] = matrix[MODES + m][MODES + j] = own - re;
      matrix[m][MODES + j] = im;
      matrix[MODES + m][j] = -im;
    }
  }
  const B = solve(matrix, right);
  const under = (part) => 2 * b * B[part] + Array.from({ length: MODES - 1 }, (_, i) => i + 1)
    .reduce((sum, m) => sum + 2 * flip(m) * B[part + m] * Math.tanh(l(m) * b) / l(m), 0);
  return { mass: density * (b * s - b ** 3 / (3 * s) + under(0)), damping: density * omega * under(MODES) };
}

const FREQUENCIES = 350, GAP = 0.1; // [rad/s]: up to 35, where nothing is radiated any more
const HIGH = [60, 80, 100, 120]; // of GAP: midway between frequencies, so that sums are principal values

/// The damping's memory K(t) = 2/pi int b cos wt dw [kg/(m s2)] at some times, and the mass [kg/m] that is left at infinite frequency:
/// a_inf = a(W) - 2/pi int b/(w^2 - W^2) dw (Ogilvie 1964).
function memory(box, times) {
  const w = Array.from({ length: FREQUENCIES }, (_, i) => (i + 0.5) * GAP), b = w.map((omega) => heavingBox(box, omega).damping);
  const sum = (f) => 2 / Math.PI * GAP * b.reduce((total, damping, k) => total + damping * f(w[k]), 0);
  const masses = HIGH.map((i) => heavingBox(box, i * GAP).mass - sum((omega) => 1 / (omega ** 2 - (i * GAP) ** 2)));
  return { kernel: times.map((t) => sum((omega) => Math.cos(omega * t))), mass: mean(masses) };
}

/// Heave of a box that floats at rest with its draft and is let go `offset` above it: { t, z } every `step` seconds.
/// (m + a_inf) z'' + int K(t - u) z'(u) du + rho g B z = 0, by trapezes, implicit in the new velocity.
export function heaveDecay(box, offset, until, step = 0.005) {
  const t = Array.from({ length: Math.round(until / step) + 1 }, (_, i) => i * step), { kernel, mass } = memory(box, t);
  const inertia = box.density * box.breadth * box.draft + mass, spring = box.density * GRAVITY * box.breadth, half = 0.5 * step;
  const z = [offset], v = [0], a = [-spring * offset / inertia];
  for (let i = 1; i < t.length; i++) {
    let past = 0;
    for (let j = 1; j < i; j++) past += step * kernel[i - j] * v[j];
    const known = v[i - 1] + half * a[i - 1] - half * (past + spring * (z[i - 1] + half * v[i - 1])) / inertia;
    v.push(known / (1 + half * half * (spring + kernel[0]) / inertia));
    z.push(z[i - 1] + half * (v[i - 1] + v[i]));
    a.push(-(past + half * kernel[0] * v[i] + spring * z[i]) / inertia);
  }
  return { t, z };
}
