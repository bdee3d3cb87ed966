// The WebSocket to lukou-console: decodes what comes, numbers what goes, and comes back by itself when it is lost.
import { create, fromBinary, toBinary } from '@bufbuild/protobuf';
import { FromPageSchema, ToPageSchema, type FromPage, type Reply, type ToPage } from '../../generated/console_pb';

export type LinkState = 'connecting' | 'open' | 'lost' | 'refused';

export interface Listener {
  message(message: ToPage): void;
  state(state: LinkState): void;
}

/** Longest wait before the next attempt [ms]. */
const LONGEST_WAIT_MS = 4000;

export class Connection {
  private socket: WebSocket | null = null;
  private wanted = true;
  private attempts = 0;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private numbered = 0;
  private waiting = new Map<number, (reply: Reply | null) => void>();

  constructor(
    private readonly url: string,
    private readonly listener: Listener,
  ) {}

  open(): void {
    this.wanted = true;
    this.listener.state(this.attempts === 0 ? 'connecting' : 'lost');
    const socket = new WebSocket(this.url);
    socket.binaryType = 'arraybuffer';
    this.socket = socket;
    socket.onopen = () => {
      this.attempts = 0;
      this.listener.state('open');
    };
    socket.onmessage = (event) => {
      if (event.data instanceof ArrayBuffer) this.take(new Uint8Array(event.data));
    };
    socket.onclose = (event) => this.closed(event.code);
  }

  close(): void {
    this.wanted = false;
    clearTimeout(this.timer);
    this.socket?.close();
  }

  /** Sends a request and gives its reply; null if the connection was lost before the reply came. */
  request(text: string): Promise<Reply | null> {
    const number = ++this.numbered;
    return new Promise((resolve) => {
      if (this.socket?.readyState !== WebSocket.OPEN) {
        resolve(null);
        return;
      }
      this.waiting.set(number, resolve);
      this.send({ case: 'request', value: { $typeName: 'lukou.console.Request', number, text } });
    });
  }

  drawn(step: number): void {
    this.send({ case: 'drawn', value: { $typeName: 'lukou.console.Drawn', step: BigInt(step) } });
  }

  takeControl(fromAnother: boolean): void {
    this.send({ case: 'takeControl', value: { $typeName: 'lukou.console.TakeControl', fromAnother } });
  }

  releaseControl(): void {
    this.send({ case: 'releaseControl', value: { $typeName: 'lukou.console.ReleaseControl' } });
  }

  private send(what: FromPage['what']): void {
    if (this.socket?.readyState !== WebSocket.OPEN) return;
    this.socket.send(toBinary(FromPageSchema, create(FromPageSchema, { what })));
  }

  private take(bytes: Uint8Array): void {
    const message = fromBinary(ToPageSchema, bytes);
    if (message.what.case === 'reply') {
      const reply = message.what.value;
      this.waiting.get(reply.number)?.(reply);
      this.waiting.delete(reply.number);
    }
    this.listener.message(message);
  }

  private closed(code: number): void {
    for (const resolve of this.waiting.values()) resolve(null);
    this.waiting.clear();
    if (!this.wanted) return;
    // 1008: the server does not want this page (wrong token, foreign origin); asking again would not help.
    if (code === 1008) {
      this.listener.state('refused');
      return;
    }
    this.listener.state('lost');
    const wait_ms = Math.min(LONGEST_WAIT_MS, 250 * 2 ** this.attempts++);
    this.timer = setTimeout(() => this.open(), wait_ms);
  }
}

/** Address of the WebSocket that belongs to the page at `location`; a token in the query goes along. */
export function socketAddress(location: { protocol: string; host: string; pathname: string; search: string }): string {
  const scheme = location.protocol === 'https:' ? 'wss:' : 'ws:';
  const folder = location.pathname.slice(0, location.pathname.lastIndexOf('/') + 1);
  return `${scheme}//${location.host}${folder}ws${location.search}`;
}
