// Water at rest: hydrostatic pressure, falling kinetic energy, level.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { atMost, holds, ROOT } from '../harness.mjs';
import { mean, rms, window } from '../signal.mjs';

const GRAVITY = 9.81, DENSITY = 1000, END = 10;

function compare(name, simulate) {
  const scene = JSON.parse(readFileSync(join(ROOT, 'cases/validation', `${name}.json`), 'utf8'));
  const spacing = scene.fluid.spacing_m, depth = -scene.domain.min_m.at(-1);
  const run = simulate(name, { until: END });
  const probes = scene.probes.pressure.map((probe) => {
    const z = probe.position_m.at(-1), pressure = run.column(`${probe.name}.pressure_pa`);
    return { z, pressure, errors: pressure.map((p) => p + DENSITY * GRAVITY * z) };
  });
  const error = rms(probes.flatMap((probe) => probe.errors)) / (DENSITY * GRAVITY * depth);
  const levels = scene.probes.gauges.map((gauge) => mean(window(run.time, run.column(`${gauge.name}.elevation_m`), END / 2, END)));
  const worst = levels.reduce((a, b) => (Math.abs(b) > Math.abs(a) ? b : a)) / spacing;
  const kinetic = run.column('energy.kinetic_j');
  const parts = [0.5, 2, 5, END].map((to, i, all) => mean(window(run.time, kinetic, all[i - 1] ?? 0, to)));
  return {
    bars: [
      atMost('pressure, rms over all probes and samples, of rho g d', error, 0.01, '%'),
      holds('mean kinetic energy of 0 to 0.5, to 2, to 5, to 10 s [J]', parts.map((e) => e.toPrecision(2)).join(', '), 'falling',
        parts.slice(2).every((e, i) => e < parts[i + 1])),
      atMost('level off the start, of dp, mean of 5 to 10 s', worst, 0.1),
    ],
    plot: { columns: 2, panels: [
      { x: 'pressure [Pa]', y: 'z [m]', title: 'pressure of the last sample', curves: [
        { label: 'rho g z', x: [0, DENSITY * GRAVITY * depth], y: [0, -depth], style: 'dashed' },
        { label: 'probes', x: probes.map((p) => p.pressure.at(-1)), y: probes.map((p) => p.z), style: 'points', colour: '#0b5fa5' }] },
      { x: 't [s]', y: 'kinetic energy [J]', title: 'kinetic energy', log: true, curves: [{ x: run.time, y: kinetic }] }] },
  };
}

export const studies = ['2', '3'].map((d) => ({
  name: `hydrostatic_${d}d`,
  title: `Still water in a ${d}-D tank for ${END} s`,
  reference: 'hydrostatics',
  compare: (simulate) => compare(`hydrostatic_${d}d`, simulate),
}));
