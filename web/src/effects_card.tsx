/** Which effects the case calls for, with each one's share of a step and its time; the others with the reason. */
import { percent, shortTime, title } from "./format.ts";
import type { Effect } from "./protocol.ts";
import type { Session } from "./session.ts";

/** What every case pays: neighbour search, the pair sweep and the integration. */
const BASE = "base";

export function EffectsCard({ session }: { session: Session }) {
  const hello = session.hello.value;
  const status = session.status.value;
  const effects = hello?.effects ?? [];
  const shares = status?.shares ?? new Map<string, number>();
  const step = (hello?.particles ?? NaN) / (status?.particle_steps_per_s ?? NaN); // wall time [s]
  const active = effects.filter((effect) => effect.active);
  const inactive = effects.filter((effect) => !effect.active);
  return (
    <section class="card effects" aria-labelledby="effects-title">
      <h2 id="effects-title">
        Effects <span class="hint">share of a step, time in it</span>
      </h2>
      <div class="scroll" tabindex={0} role="region" aria-labelledby="effects-title">
        <ul aria-label="Effects that take part">
          {shares.has(BASE) && <Cost name="Base" tip="neighbours, pair sweeps, integration" share={shares.get(BASE) ?? NaN} step={step} />}
          {active.map((effect) => (
            <Cost key={effect.name} name={title(effect.name)} tip={tipOf(effect)} share={shares.get(effect.name) ?? NaN} step={step} cost={effect.cost} />
          ))}
        </ul>
        <h3>Off</h3>
        <ul aria-label="Effects that are left out">
          {inactive.map((effect) => (
            <li key={effect.name} class="inactive" title={tipOf(effect)}>
              <span class="name">{title(effect.name)}</span>
              <span class="because">{effect.because}</span>
            </li>
          ))}
        </ul>
      </div>
    </section>
  );
}

const HOW_KNOWN: Record<Effect["cost"], string> = {
  clocked: "",
  sampled: "Time: its share of a sweep, measured once at the start, of the sweep's clock now.",
  elsewhere: "It takes no part in a step.",
};

function tipOf({ active, because, called_by, source, cost }: Effect): string {
  const reason = `${active ? "On" : "Off"} because ${because}.`;
  return [reason, active ? HOW_KNOWN[cost] : `Called for by ${called_by}.`, source].filter((part) => part !== "").join("\n");
}

type CostProps = { name: string; tip: string; share: number; step: number; cost?: Effect["cost"] };

function Cost({ name, tip, share, step, cost = "clocked" }: CostProps) {
  const width = Number.isFinite(share) ? Math.min(1, Math.max(0, share)) * 100 : 0;
  const about = cost === "sampled" ? "≈ " : "";
  if (cost === "elsewhere")
    return (
      <li title={tip} class="beside">
        <span class="name">{name}</span>
        <span class="figure">beside the steps</span>
      </li>
    );
  return (
    <li title={tip}>
      <span class="name">{name}</span>
      <span class="track" aria-hidden="true">
        <span class="share" style={{ width: `${width}%` }} />
      </span>
      <span class="figure">{percent(share)}</span>
      <span class="figure time">{share > 0 ? about + shortTime(share * step) : shortTime(NaN)}</span>
    </li>
  );
}
