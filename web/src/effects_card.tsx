/** Which effects the case calls for, with each one's share of a step's time; the others with the reason. */
import { percent, title } from "./format.ts";
import type { Session } from "./session.ts";

/** What every case pays: neighbour search, the pair sweep and the integration. */
const BASE = "base";

export function EffectsCard({ session }: { session: Session }) {
  const effects = session.hello.value?.effects ?? [];
  const shares = session.status.value?.shares ?? new Map<string, number>();
  const active = effects.filter((effect) => effect.active);
  const inactive = effects.filter((effect) => !effect.active);
  return (
    <section class="card effects" aria-labelledby="effects-title">
      <h2 id="effects-title">
        Effects <span class="hint">share of a step</span>
      </h2>
      <div class="scroll" tabindex={0} role="region" aria-labelledby="effects-title">
        <ul>
          {shares.has(BASE) && <Share name="Base" because="neighbours, pair sweep, integration" share={shares.get(BASE) ?? NaN} />}
          {active.map(({ name, because, kind }) => (
            <Share
              key={name}
              name={title(name)}
              because={because}
              share={shares.get(name) ?? NaN}
              inSweep={kind === "pair" && !shares.has(name)}
            />
          ))}
          {inactive.map(({ name, because }) => (
            <li key={name} class="inactive" title={because}>
              <span class="name">{title(name)}</span>
              <span class="because">{because}</span>
            </li>
          ))}
        </ul>
      </div>
    </section>
  );
}

type ShareProps = { name: string; because: string; share: number; inSweep?: boolean };

function Share({ name, because, share, inSweep = false }: ShareProps) {
  const width = Number.isFinite(share) ? Math.min(1, Math.max(0, share)) * 100 : 0;
  return (
    <li title={because} class={inSweep ? "swept" : ""}>
      <span class="name">{name}</span>
      {!inSweep && (
        <span class="track" aria-hidden="true">
          <span class="share" style={{ width: `${width}%` }} />
        </span>
      )}
      <span class="figure">{inSweep ? "in sweep" : percent(share)}</span>
    </li>
  );
}
