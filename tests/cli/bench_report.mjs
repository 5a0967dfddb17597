// Is the JSON of `fairlead bench` what was promised? bench_report.mjs FILE
import { readFileSync } from "node:fs";

const report = JSON.parse(readFileSync(process.argv[2], "utf8"));
const wrong = [];
const expect = (fact, what) => fact || wrong.push(what);
const near = (a, b, tolerance) => Math.abs(a / b - 1) <= tolerance;

for (const key of ["version", "cpu", "backend", "level", "scene"])
    expect(typeof report[key] === "string" && report[key] !== "", `${key}: ${report[key]}`);
for (const key of [
    "threads", "dimensions", "particles", "fluid_particles", "dummy_particles", "spacing_m",
    "smoothing_ratio", "neighbours", "neighbours_sample", "momentum_passes_per_step",
    "density_passes_per_step", "time_step_s", "courant", "steps", "groups", "step_s",
    "ns_per_particle_step", "ns_per_fluid_particle_step", "particle_steps_per_second",
    "directed_pairs_per_second", "simulated_seconds_per_second", "steps_per_sort", "flops_per_step",
    "fraction_of_peak", "fraction_of_bandwidth", "bytes_per_particle", "bytes_per_fluid_particle",
    "peak_resident_bytes", "clock_hz", "peak_flops", "peak_clock_hz", "bandwidth_bytes_per_second",
])
    expect(Number.isFinite(report[key]) && report[key] > 0, `${key}: ${report[key]}`);
for (const key of ["sorts", "preemptions", "roll_backs"])
    expect(Number.isInteger(report[key]) && report[key] >= 0, `${key}: ${report[key]}`);
for (const key of ["fluid_momentum", "fluid_density", "dummy_momentum", "dummy_density"])
    expect(report.flops_per_pair[key] > 0, `flops_per_pair.${key}`);

expect(report.fluid_particles + report.dummy_particles === report.particles, "fluid + dummies");
expect(near(report.particles, report.particles_asked, 0.03), `${report.particles} particles`);
expect(near(report.smoothing_ratio, 2.08, 1e-6), `h/dp ${report.smoothing_ratio}`);
expect(report.neighbours > 100 && report.neighbours < 320, `${report.neighbours} neighbours`);
expect(report.groups >= 5, `${report.groups} groups`);
expect(
    near(report.ns_per_particle_step * report.particles, report.step_s * 1e9, 1e-6) &&
        near(report.ns_per_fluid_particle_step * report.fluid_particles, report.step_s * 1e9, 1e-6),
    "time of a particle times particles is the time of a step",
);
const steps = report.group_step_s;
const half = steps.length / 2;
expect(steps.length === report.groups && steps[0] === report.step_fastest_s, "groups");
expect(near((steps[Math.ceil(half) - 1] + steps[Math.floor(half)]) / 2, report.step_s, 1e-6), "median");
expect(report.fraction_of_peak < 1 && report.fraction_of_bandwidth < 1, "more than the machine can");
expect(report.clock_hz > 3e8 && report.clock_hz < 1e10, `clock ${report.clock_hz}`);
const shares = Object.values(report.shares);
const sum = shares.reduce((total, share) => total + share, 0);
expect(shares.every((share) => share >= 0) && sum > 0.9 && sum < 1.01, `shares sum to ${sum}`);

console.log(wrong.length ? `wrong: ${wrong.join("; ")}` : "as promised");
process.exit(wrong.length ? 1 : 0);
