/** One web socket that is opened again whenever it is lost. Knows the wire, nothing of the page. */
import {
  parseMessage,
  parsePicture,
  PROTOCOL,
  SUBPROTOCOL,
  type ClientMessage,
  type Picture,
  type ServerMessage,
} from "./protocol.ts";

const FIRST_PAUSE_MS = 500;
const LONGEST_PAUSE_MS = 5000;
/** The server speaks five times a second; so long a silence means that it is gone. */
const SILENCE_MS = 10_000;

export type ConnectionEvents = {
  opened(): void;
  /** @param retryAt  when the next attempt is made, as Date.now() */
  lost(retryAt: number): void;
  message(message: ServerMessage): void;
  picture(picture: Picture): void;
  /** A message that does not follow the protocol; the connection goes on. */
  unreadable(error: unknown): void;
};

export class Connection {
  private socket: WebSocket | null = null;
  private pause = FIRST_PAUSE_MS;
  private retry: ReturnType<typeof setTimeout> | undefined;
  private watchdog: ReturnType<typeof setTimeout> | undefined;

  constructor(
    private readonly url: string,
    private readonly events: ConnectionEvents,
  ) {}

  /** Opens now, instead of waiting for the next attempt. */
  open(): void {
    clearTimeout(this.retry);
    this.abandon();
    const socket = new WebSocket(this.url, SUBPROTOCOL);
    socket.binaryType = "arraybuffer";
    this.socket = socket;
    this.listen();
    socket.onopen = () => {
      this.send({ type: "hello", protocol: PROTOCOL });
      this.events.opened();
    };
    socket.onmessage = ({ data }: MessageEvent<string | ArrayBuffer>) => this.receive(data);
    socket.onclose = () => this.lose();
  }

  /** @return false when there is no connection: the message is not sent, later or ever */
  send(message: ClientMessage): boolean {
    if (this.socket?.readyState !== WebSocket.OPEN) return false;
    this.socket.send(JSON.stringify(message));
    return true;
  }

  private receive(data: string | ArrayBuffer): void {
    this.listen();
    try {
      if (typeof data === "string") {
        const message = parseMessage(data);
        if (message.type === "hello") this.pause = FIRST_PAUSE_MS;
        this.events.message(message);
      } else this.events.picture(parsePicture(data));
    } catch (error) {
      this.events.unreadable(error);
    }
  }

  private listen(): void {
    clearTimeout(this.watchdog);
    this.watchdog = setTimeout(() => this.lose(), SILENCE_MS);
  }

  private lose(): void {
    this.abandon();
    this.events.lost(Date.now() + this.pause);
    clearTimeout(this.retry);
    this.retry = setTimeout(() => this.open(), this.pause);
    this.pause = Math.min(LONGEST_PAUSE_MS, this.pause * 2);
  }

  private abandon(): void {
    clearTimeout(this.watchdog);
    if (!this.socket) return;
    this.socket.onopen = this.socket.onmessage = this.socket.onclose = null;
    this.socket.close();
    this.socket = null;
  }
}
