/** What the picture shows, how finely it is drawn, and stills of it. */
import { useSignal } from "@preact/signals";
import { saveFile } from "./download.ts";
import { Icon } from "./icons.tsx";
import { COLOUR_FIELDS, WATER_MODES, type ColourField, type WaterMode } from "./protocol.ts";
import type { Session } from "./session.ts";
import { QUALITIES, quality, type Quality } from "./settings.ts";

const WATER_NAMES: Record<WaterMode, string> = { surface: "Surface", particles: "Particles" };
const FIELD_NAMES: Record<ColourField, string> = {
  none: "Water",
  elevation: "Elevation",
  speed: "Speed",
  pressure: "Pressure",
};
const STILL_SIZES = [
  [960, 540],
  [1280, 720],
  [1920, 1080],
  [2560, 1440],
] as const;

type ChoiceProps<T extends string> = {
  id: string;
  label: string;
  value: T;
  names: Record<T, string>;
  choices: readonly T[];
  disabled?: boolean;
  onChoose: (choice: T) => void;
};

function Choice<T extends string>({ id, label, value, names, choices, disabled, onChoose }: ChoiceProps<T>) {
  const choose = (event: Event): void => {
    if (!(event.currentTarget instanceof HTMLSelectElement)) return;
    const choice = choices[event.currentTarget.selectedIndex];
    if (choice !== undefined) onChoose(choice);
  };
  return (
    <div class="choice">
      <label for={id}>{label}</label>
      <select id={id} value={value} disabled={disabled ?? false} onChange={choose}>
        {choices.map((choice) => (
          <option key={choice} value={choice}>
            {names[choice]}
          </option>
        ))}
      </select>
    </div>
  );
}

export function ViewCard({ session }: { session: Session }) {
  const { water = "surface", field = "none" } = session.view.value;
  const disabled = !session.connected.value;
  const qualities = Object.keys(QUALITIES) as Quality[];
  const qualityNames = Object.fromEntries(qualities.map((name) => [name, QUALITIES[name].label])) as Record<Quality, string>;
  return (
    <section class="card view" aria-labelledby="view-title">
      <h2 id="view-title">Picture</h2>
      <Choice id="water" label="Draw" value={water} names={WATER_NAMES} choices={WATER_MODES} disabled={disabled} onChoose={(choice) => session.setView({ water: choice })} />
      <Choice id="field" label="Colour" value={field} names={FIELD_NAMES} choices={COLOUR_FIELDS} disabled={disabled} onChoose={(choice) => session.setView({ field: choice })} />
      <Choice id="quality" label="Live" value={quality.value} names={qualityNames} choices={qualities} onChoose={(choice) => (quality.value = choice)} />
      <Still session={session} />
    </section>
  );
}

function Still({ session }: { session: Session }) {
  const size = useSignal(2);
  const busy = useSignal(false);
  const take = async (): Promise<void> => {
    const [width, height] = STILL_SIZES[size.value] ?? STILL_SIZES[0];
    const name = session.hello.value?.case.name ?? "fairlead";
    busy.value = true;
    try {
      const picture = await session.snapshot(width, height);
      const file = `${name}_t${picture.time_s.toFixed(2)}s_${picture.width}x${picture.height}.png`;
      saveFile(file, new Blob([picture.payload], { type: "image/png" }));
      session.notify("info", `Saved ${file}`);
    } catch (error) {
      session.notify("bad", `No still picture: ${error instanceof Error ? error.message : String(error)}`);
    }
    busy.value = false;
  };
  return (
    <div class="still">
      <div class="choice">
        <label for="still-size">Still</label>
        <select
          id="still-size"
          value={String(size.value)}
          onChange={(event) => (size.value = event.currentTarget.selectedIndex)}
        >
          {STILL_SIZES.map(([width, height], index) => (
            <option key={width} value={String(index)}>
              {width} × {height}
            </option>
          ))}
        </select>
      </div>
      <button type="button" disabled={busy.value || !session.connected.value} onClick={() => void take()}>
        <Icon name="camera" />
        <span>{busy.value ? "Drawing" : "Save PNG"}</span>
      </button>
    </div>
  );
}
