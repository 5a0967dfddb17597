// A wedge that strikes still water: force and pressure grow as the similarity solution has them (Dobrovol'skaya 1969; figures of
// Zhao & Faltinsen 1993, J. Fluid Mech. 246, 593, table 1, from memory: the paper was not read again).
import { atMost, sceneOf } from '../harness.mjs';
import { largest, mean } from '../signal.mjs';

const GRAVITY = 9.81, DENSITY = 1000, FROM = 0.12, END = 0.36;
const SIMILARITY = { 20: { force: 42.485, pressure: 17.774, place: 0.5087 }, 30: { force: 14.139, pressure: 6.927, place: 0.4243 } };

/// Mean of the values whose place lies in each tenth. @return [{ x, y }], by rising place
function binned(points) {
  const bins = new Map();
  for (const { x, y } of points) {
    const at = Math.round(10 * x);
    bins.set(at, [...(bins.get(at) ?? []), y]);
  }
  return [...bins].sort((a, b) => a[0] - b[0]).map(([at, values]) => ({ x: at / 10, y: mean(values) }));
}

function compare(deadrise, simulate) {
  const name = `wedge_entry_${deadrise}`, scene = sceneOf(name), reference = SIMILARITY[deadrise], slope = Math.tan(deadrise * Math.PI / 180);
  const { amplitude_m: amplitude, period_s: period } = scene.bodies[0].freedoms.heave.prescribed, omega = 2 * Math.PI / period;
  const run = simulate(name, { until: 0.066 });
  const force = run.column('wedge.fluid_fz_n'), forces = [], pressures = [], curve = { x: [], y: [] };
  const probes = scene.probes.pressure.map((probe) => ({ z: probe.position_m.at(-1), p: run.column(`${probe.name}.pressure_pa`) }));
  run.time.forEach((t, i) => {
    const speed = amplitude * omega * Math.cos(omega * t), deep = amplitude * Math.sin(omega * t) - scene.bodies[0].position_m.at(-1);
    if (deep < 0.03 || deep > END) return;
    const weight = DENSITY * GRAVITY * deep * deep / slope; // of the water up to its level at rest
    const coefficient = (force[i] - weight) / (DENSITY * speed * speed * deep);
    curve.x.push(deep);
    curve.y.push(coefficient);
    if (deep < FROM) return;
    forces.push(coefficient);
    for (const { z, p } of probes) pressures.push({ x: z / deep - 1, y: p[i] / (0.5 * DENSITY * speed * speed) });
  });
  const profile = binned(pressures.filter(({ x }) => x > -1 && x < 0.95)), peak = largest(profile.map((bin) => bin.y));
  return {
    bars: [
      atMost(`mean force over rho V^3 t, off ${reference.force}`, mean(forces) / reference.force - 1, 0.1, '%'),
      atMost(`largest mean pressure over rho V^2/2, off ${reference.pressure}`, peak / reference.pressure - 1, 0.15, '%'),
    ],
    notes: [`Force ${mean(forces).toFixed(2)} rho V^3 t, mean of depths from ${FROM} to ${END} m; pressure ${peak.toFixed(2)} rho V^2/2 at ` +
      `${profile.find((bin) => bin.y === peak).x.toFixed(1)} V t above still water (similarity ${reference.place}), means over tenths. The bars are ours; sound goes at 20 times the speed of the wedge.`],
    plot: { columns: 2, panels: [
      { x: 'depth of the keel [m]', y: 'force over rho V^3 t', yrange: [0, 2 * reference.force], curves: [
        { label: 'simulated', style: 'thin', colour: '#9cc3e6', x: curve.x, y: curve.y },
        { label: 'similarity solution', style: 'dashed', x: [0.03, END], y: [reference.force, reference.force] }] },
      { x: 'height over still water, over V t', y: 'pressure over rho V^2/2', yrange: [0, 1.4 * reference.pressure], key: 'top left', curves: [
        { label: 'mean of all probes and times', style: 'points', colour: '#0b5fa5', x: profile.map((bin) => bin.x), y: profile.map((bin) => bin.y) },
        { label: 'largest of the similarity solution', style: 'points', colour: '#c74a2e', x: [reference.place], y: [reference.pressure] }] }] },
  };
}

export const studies = [20, 30].map((deadrise) => ({
  name: `wedge_entry_${deadrise}`,
  title: sceneOf(`wedge_entry_${deadrise}`).title,
  reference: 'similarity solution, Zhao & Faltinsen 1993',
  compare: (simulate) => compare(deadrise, simulate),
}));
