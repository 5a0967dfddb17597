// Bodies at rest: drafts, and what thin plates feel.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { atMost, ROOT } from '../harness.mjs';
import { mean, window } from '../signal.mjs';

const GRAVITY = 9.81, DENSITY = 1000, FROM = 3, END = 6, WITHIN = 0.25;

function compare(name, simulate) {
  const scene = JSON.parse(readFileSync(join(ROOT, 'cases/validation', `${name}.json`), 'utf8'));
  const spacing = scene.fluid.spacing_m, run = simulate(name, { until: END });
  const late = (column) => mean(window(run.time, run.column(column), FROM, END));
  const floats = scene.bodies.filter((body) => body.freedoms !== 'fixed');
  const bars = floats.map((body) => atMost(`${body.name}: heave off the hydrostatic draft, of dp`, late(`${body.name}.heave_m`) / spacing, WITHIN));
  for (const body of scene.bodies.filter((b) => b.freedoms === 'fixed')) {
    const [length, height] = [body.size_m[0], body.size_m.at(-1)], low = body.position_m.at(-1) - height / 2;
    const lift = DENSITY * GRAVITY * length * Math.min(height, -low), force = late(`${body.name}.fluid_fz_n`);
    bars.push(atMost(`${body.name}: force ${force.toFixed(1)} N off buoyancy ${lift.toFixed(1)} N, as draft, of dp`,
      (force - lift) / (DENSITY * GRAVITY * length) / spacing, WITHIN));
  }
  return {
    bars,
    plot: { panels: [{ x: 't [s]', y: 'heave / dp [-]', yrange: [-0.5, 0.5], curves: [
      ...floats.map((body) => ({ label: body.name, x: run.time, y: run.column(`${body.name}.heave_m`).map((z) => z / spacing) })),
      ...[-WITHIN, WITHIN].map((z) => ({ label: z < 0 ? '' : 'bar', style: 'dashed', x: [0, END], y: [z, z] }))] }] },
  };
}

export const studies = ['2', '3'].map((d) => ({
  name: `drafts_${d}d`,
  title: `Bodies at rest in still water, ${d}-D`,
  reference: 'hydrostatics',
  compare: (simulate) => compare(`drafts_${d}d`, simulate),
}));
