// Water that flows through a basin as it came: nothing but the coming and going of particles can change it.
import { atMost, sceneOf } from '../harness.mjs';
import { largest, mean, rms, smallest, window } from '../signal.mjs';

const GRAVITY = 9.81, DENSITY = 1000, UNTIL = 40, FROM = 10;
const COLOURS = ['#0b5fa5', '#217a4b', '#c74a2e', '#7648b0'];

function compare(simulate) {
  const scene = sceneOf('current_uniform'), run = simulate('current_uniform', { until: UNTIL });
  const depth = -scene.domain.min_m.at(-1), spacing = scene.fluid.spacing_m;
  const late = (column) => window(run.time, run.column(column), FROM, Infinity);
  const kinetic = run.column('energy.kinetic_j');
  const levels = scene.probes.gauges.map((gauge) => mean(late(`${gauge.name}.elevation_m`)));
  const off = scene.probes.pressure.flatMap((probe) => late(`${probe.name}.pressure_pa`)
    .map((p) => (p + DENSITY * GRAVITY * probe.position_m.at(-1)) / (DENSITY * GRAVITY * depth)));
  const worst = levels.reduce((a, b) => (Math.abs(b) > Math.abs(a) ? b : a));
  return {
    bars: [
      atMost('mean kinetic energy after 10 s off that of all water at 0.5 m/s', mean(late('energy.kinetic_j')) / kinetic[0] - 1, 0.01, '%'),
      atMost('level of the gauges, worst, of dp', worst / spacing, 0.1),
      atMost('pressure, rms over probes and samples, of rho g d', rms(off), 0.01, '%'),
      atMost('particles lost behind the walls', run.summary.health.lost_particles, 0),
    ],
    notes: [`Levels ${levels.map((z) => (1e3 * z).toFixed(2)).join(', ')} mm; kinetic energy ${smallest(late('energy.kinetic_j')).toFixed(1)} to ` +
      `${largest(late('energy.kinetic_j')).toFixed(1)} J, ${kinetic[0].toFixed(1)} J at the start. The bars are ours.`],
    plot: { columns: 2, panels: [
      { x: 't [s]', y: 'pressure [kPa]', yrange: [0, 6.5], key: 'top right', curves: scene.probes.pressure.map((probe, i) => ({
        label: `${-probe.position_m.at(-1)} m deep, x = ${probe.position_m[0]} m`, style: 'thin', colour: COLOURS[i], x: run.time,
        y: run.column(`${probe.name}.pressure_pa`).map((p) => p / 1000) })) },
      { x: 't [s]', y: 'kinetic energy over that of the start', yrange: [0.97, 1.03], curves: [
        { label: 'simulated', x: run.time, y: kinetic.map((e) => e / kinetic[0]) },
        ...[0.99, 1.01].map((y) => ({ label: y < 1 ? 'bar' : '', style: 'dashed', x: [0, UNTIL], y: [y, y] }))] }] },
  };
}

export const studies = [{
  name: 'current_uniform',
  title: 'Uniform current through a basin, 2-D',
  reference: 'uniform flow',
  compare,
}];
