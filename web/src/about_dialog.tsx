/** What the run is made of: case, machine, warnings, and every effect with the reason it is on or off. */
import { Dialog } from "./dialog.tsx";
import { bytes, grouped, significant, title } from "./format.ts";
import type { Hello } from "./protocol.ts";

type Props = { hello: Hello; open: boolean; onClose: () => void };

export function AboutDialog({ hello, open, onClose }: Props) {
  const facts: [string, string][] = [
    ["Case", `${hello.case.name} (${hello.case.hash})`],
    ["Particles", `${grouped(hello.particles)}, spacing ${significant(hello.spacing_m)} m`],
    ["Backend", `${hello.backend}, ${hello.threads} thread${hello.threads === 1 ? "" : "s"}`],
    ["Pictures", hello.renderer],
    ["Version", `${hello.version}, protocol ${hello.protocol}`],
  ];
  return (
    <Dialog title={hello.case.title} open={open} onClose={onClose}>
      {hello.warnings.length > 0 && (
        <ul class="warnings" aria-label="Warnings">
          {hello.warnings.map((warning) => (
            <li key={warning}>{warning}</li>
          ))}
        </ul>
      )}
      <dl class="facts">
        {facts.map(([name, value]) => (
          <div key={name}>
            <dt>{name}</dt>
            <dd>{value}</dd>
          </div>
        ))}
      </dl>
      <div class="scroll" tabindex={0} role="region" aria-label="Effects">
        <table>
          <thead>
            <tr>
              <th scope="col">Effect</th>
              <th scope="col">Kind</th>
              <th scope="col">Memory</th>
              <th scope="col">Because</th>
            </tr>
          </thead>
          <tbody>
            {hello.effects.map((effect) => (
              <tr key={effect.name} class={effect.active ? "" : "inactive"}>
                <th scope="row">{title(effect.name)}</th>
                <td>{effect.active ? effect.kind : "off"}</td>
                <td class="figure">{effect.active ? bytes(effect.bytes) : "–"}</td>
                <td>{effect.because}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
      <div class="answers">
        <button type="button" class="primary" onClick={onClose}>
          Close
        </button>
      </div>
    </Dialog>
  );
}
