/** Short messages at the foot of the page: refusals and confirmations. */
import { Icon } from "./icons.tsx";
import type { Session } from "./session.ts";

export function Notices({ session }: { session: Session }) {
  return (
    <div class="notices" role="status">
      {session.notices.value.map(({ id, tone, text }) => (
        <div key={id} class={`notice ${tone}`}>
          <p>{text}</p>
          <button type="button" class="quiet square" aria-label="Dismiss" onClick={() => session.dismiss(id)}>
            <Icon name="close" />
          </button>
        </div>
      ))}
    </div>
  );
}
