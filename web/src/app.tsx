/** The page, in the order of the keyboard and of a narrow screen; the style sheet lays it out. */
import { useEffect } from "preact/hooks";
import { EffectsCard } from "./effects_card.tsx";
import { Header } from "./header.tsx";
import { LineBar } from "./line_bar.tsx";
import { Meters } from "./meters.tsx";
import { Notices } from "./notices.tsx";
import { PictureView } from "./picture.tsx";
import { Plots } from "./plots.tsx";
import type { Session } from "./session.ts";
import { isDark } from "./settings.ts";
import { ViewCard } from "./view_card.tsx";
import { WaveCard } from "./wave_card.tsx";

export function App({ session }: { session: Session }) {
  const dark = isDark();
  // before the children draw: the plots read their colours from it
  document.documentElement.dataset["theme"] = dark ? "dark" : "light";
  const title = session.hello.value?.case.title;
  useEffect(() => {
    document.title = title ? `${title} – Fairlead` : "Fairlead";
  }, [title]);
  return (
    <>
      <a class="skip" href="#controls">
        Skip to the controls
      </a>
      <Header session={session} />
      <main>
        <PictureView session={session} />
        <Meters session={session} />
        <LineBar session={session} />
        <WaveCard session={session} />
        <Plots session={session} />
        <ViewCard session={session} />
        <EffectsCard session={session} />
      </main>
      <Notices session={session} />
    </>
  );
}
