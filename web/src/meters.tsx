/** The strip of figures about the run: time, speed, size, step, health. */
import { fixed, grouped, percent, shortTime, significant } from "./format.ts";
import type { Status } from "./protocol.ts";
import type { Session } from "./session.ts";

type Meter = { label: string; value: string; unit?: string; hint: string };

const STATE_NAMES = { running: "Running", paused: "Paused", failed: "Failed" } as const;
const HEALTH_NAMES = { good: "Good", recovered: "Recovered", failed: "Failed" } as const;

function metersOf(status: Status | null, particles: number): Meter[] {
  return [
    { label: "Time", value: fixed(status?.time_s ?? NaN, 2), unit: "s", hint: "Simulated time" },
    { label: "Speed", value: significant(status?.speed ?? NaN), unit: "× real", hint: "Simulated seconds per second of wall time" },
    { label: "Particles", value: grouped(particles), hint: "Fluid and boundary particles" },
    { label: "Step", value: grouped(status?.step ?? NaN), hint: "Time steps made" },
    { label: "Time step", value: shortTime(status?.time_step_s ?? NaN), hint: "Length of the last time step" },
    { label: "Updates", value: significant((status?.particle_steps_per_s ?? NaN) / 1e6), unit: "M/s", hint: "Particle steps per second, in millions" },
    { label: "Density error", value: percent(status?.density_error ?? NaN, 2), hint: "Largest deviation from the rest density" },
    { label: "Pictures", value: fixed(status?.frames_per_s ?? NaN, 1), unit: "/s", hint: "Pictures drawn per second" },
  ];
}

export function Meters({ session }: { session: Session }) {
  const status = session.status.value;
  const health = status?.health;
  const lost = session.link.value.state === "lost";
  const lamp = lost ? "" : status?.state === "failed" ? "failed" : (health?.status ?? "");
  return (
    <section class="meters" aria-label="State of the run">
      <dl>
        <div class={`meter lamp ${lamp}`} title={health?.message || "Health of the physics"}>
          <dt>{lost ? "Connection" : status ? STATE_NAMES[status.state] : "Health"}</dt>
          <dd>{lost ? "Lost" : health ? HEALTH_NAMES[health.status] : "–"}</dd>
        </div>
        {metersOf(status, session.hello.value?.particles ?? NaN).map(({ label, value, unit, hint }) => (
          <div class="meter" key={label} title={hint}>
            <dt>{label}</dt>
            <dd>
              {value}
              {unit && <span class="unit"> {unit}</span>}
            </dd>
          </div>
        ))}
      </dl>
    </section>
  );
}
