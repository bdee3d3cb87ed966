// All that the page knows: what the server said, newest last, and what the user looks at. Nothing of the simulation stands here
// that did not come over the wire.
import type { Event, Hands, Hello, Reply, RunStatus, Statistics, ToPage } from '../../generated/console_pb';
import { Path } from '../view/path';
import { Playback } from '../view/playback';
import { Connection, type LinkState } from '../wire/connection';
import { sceneOf, type Scene } from '../wire/scene';
import { arrivedAt, asked, directed, fieldsAt, fieldsOf, refusedWith, type Fields } from './fields';
import { ThinningRing } from './ring';
import { pushed, restoring, standing, type Undo } from './undo';

/** Pictures kept for looking back: two to four minutes step by step at real time, and everything before more coarsely. */
const SCENES_KEPT = 2400;
const SAMPLES_KEPT = 1600;
const EVENTS_KEPT = 300;
/** How often the parts of the page that follow the picture are brought up to date [ms]. */
const FOLLOW_MS = 200;

export interface Sample {
  readonly step: number;
  readonly statistics: Statistics;
}

export interface Note {
  readonly step: number;
  readonly kind: string;
  readonly text: string;
}

export class Console {
  link = $state<LinkState>('connecting');
  hello = $state.raw<Hello | null>(null);
  status = $state.raw<RunStatus | null>(null);
  statistics = $state.raw<Statistics | null>(null);
  hands = $state.raw<Hands | null>(null);
  notes = $state.raw<readonly Note[]>([]);
  fields = $state.raw<Fields>(new Map());
  refusal = $state(''); // of the last request that was refused
  newest = $state.raw<Scene | null>(null); // follows the newest picture a few times a second
  samplesSeen = $state(0); // counts changes of `samples`
  ghost = $state.raw<readonly Sample[]>([]); // what the charts compare with; empty: nothing
  scrubbed = $state<number | null>(null); // step that the user looks back at; null: live
  seeking = $state<number | null>(null); // step that a recording is asked to go on from
  private undos = $state.raw<readonly (readonly Undo[])[]>([]);

  paths: readonly Path[] = $derived((this.hello?.lanes ?? []).map((lane) => new Path(lane)));
  stepS = $derived(this.hello?.stepS ?? 0.1);
  inControl = $derived(this.hands !== null && this.hands.holder !== 0 && this.hands.holder === this.hello?.viewer);
  mayAct = $derived(this.link === 'open' && (this.inControl || (this.hands?.holder ?? 0) === 0));
  over = $derived(this.status?.phase === 'ended' || this.status?.phase === 'aborted');
  /** The last step of a recording; null: a run that goes on. */
  recordedTo = $derived(this.hello?.recordedTo === undefined ? null : Number(this.hello.recordedTo));
  /** Whether values may be set. */
  maySet = $derived(this.mayAct && !this.over && this.recordedTo === null);
  /** The newest changes of this page that can be taken back. */
  undoable = $derived(this.undos[this.undos.length - 1] ?? []);

  readonly scenes = new ThinningRing<Scene>(SCENES_KEPT);
  readonly samples = new ThinningRing<Sample>(SAMPLES_KEPT);
  readonly playback = new Playback();
  private readonly connection: Connection;
  private greeted = false; // on this connection
  private followedMs = 0;
  private following: ReturnType<typeof setTimeout> | undefined;
  private undrawn: number[] = []; // steps of pictures that came since the last frame
  private seekUnderWay = false;

  constructor(url: string) {
    this.connection = new Connection(url, {
      message: (message) => this.take(message),
      state: (state) => this.linked(state),
    });
    this.connection.open();
  }

  /** Asks for something; takes control first if nobody has it. Refusals are also kept in `refusal`. */
  async ask(text: string): Promise<Reply | null> {
    if (!this.inControl) this.connection.takeControl(false);
    const reply = await this.connection.request(text);
    this.refusal = reply !== null && !reply.ok ? reply.text : '';
    return reply;
  }

  /** Sets a field; the step before can be undone. A refusal stands beside the field. */
  async set(path: string, value: string): Promise<Reply | null> {
    const [reply] = await this.setTogether([{ path, value }]);
    return reply;
  }

  /** Sets fields one after the other, as one step to undo. */
  async setTogether(values: readonly { path: string; value: string }[]): Promise<(Reply | null)[]> {
    const steps: Undo[] = [];
    const replies: (Reply | null)[] = [];
    for (const { path, value } of values) {
      const before = restoring(this.fields, path);
      const reply = await this.put(path, value);
      if (reply?.ok && before !== null) steps.push({ path, set: value, before });
      replies.push(reply);
    }
    this.undos = pushed(this.undos, steps);
    return replies;
  }

  /** Sets the newest changes back, unless somebody has changed the field since. */
  async undo(): Promise<void> {
    const steps = standing(this.undoable, this.fields);
    this.undos = this.undos.slice(0, -1);
    for (const { before } of [...steps].reverse()) await this.put(before.path, before.value);
  }

  private async put(path: string, value: string): Promise<Reply | null> {
    this.fields = asked(this.fields, path, value);
    const reply = await this.ask(`set ${path}=${value}`);
    // The clock repeats what it was asked; that stands beside the words already.
    const why = (reply?.text ?? '').replace(`${path}=${value}: `, () => '');
    if (reply === null || !reply.ok) this.fields = refusedWith(this.fields, path, why);
    this.refusal = '';
    return reply;
  }

  /** Lets a recording go on from another step. While one seek is under way the newest wish alone waits for its turn. */
  async seek(step: number): Promise<void> {
    if (this.recordedTo === null) return;
    this.seeking = Math.min(Math.max(0, step), this.recordedTo);
    if (this.seekUnderWay) return;
    this.seekUnderWay = true;
    let sent: number | null = null;
    while (this.seeking !== null && this.seeking !== sent) {
      sent = this.seeking;
      const reply = await this.ask(`seek ${(sent * this.stepS).toFixed(1)}`);
      if (!reply?.ok) this.seeking = null;
    }
    this.seekUnderWay = false;
  }

  takeControl(): void {
    this.connection.takeControl(true);
  }

  releaseControl(): void {
    this.connection.releaseControl();
  }

  /** Keeps the figures so far as the charts' ghost, or drops the one that is kept. Another run leaves it alone. */
  toggleGhost(): void {
    this.ghost = this.ghost.length > 0 ? [] : [...this.samples.all()];
  }

  /** Looks `by` pictures back or forth from the one that is shown; beyond the newest it is live again. A recording goes there. */
  lookBy(by: number): void {
    if (this.recordedTo !== null) {
      void this.seek((this.seeking ?? this.scenes.last?.step ?? 0) + by);
      return;
    }
    const from = this.scrubbed ?? this.scenes.last?.step ?? -1;
    const index = Math.max(0, this.scenes.indexAt(from) + by);
    this.scrubbed = index >= this.scenes.length - 1 ? null : (this.scenes.at(index)?.step ?? null);
  }

  /** Shows a step of the time before, or the picture that is kept next before it; at the end it is live. A recording goes there. */
  lookAt(step: number): void {
    if (this.recordedTo !== null) {
      void this.seek(step);
      return;
    }
    const place = Math.max(0, this.scenes.indexAt(step));
    this.scrubbed = step >= (this.scenes.last?.step ?? 0) ? null : (this.scenes.at(place)?.step ?? null);
  }

  /** What has come is on the screen: the next pictures may come. */
  drawn(): void {
    for (const step of this.undrawn) this.connection.drawn(step);
    this.undrawn = [];
  }

  private linked(state: LinkState): void {
    this.link = state;
    this.greeted = false;
  }

  private take({ what }: ToPage): void {
    switch (what.case) {
      case 'hello':
        return this.greet(what.value);
      case 'status':
        this.status = what.value;
        return;
      case 'picture':
        return this.show(sceneOf(what.value, this.scenes.last));
      case 'statistics':
        this.statistics = what.value;
        return this.sample(what.value);
      case 'history':
        for (const statistics of what.value.samples) this.sample(statistics);
        this.statistics ??= what.value.samples[what.value.samples.length - 1] ?? null;
        for (const event of what.value.events) this.note(event);
        return;
      case 'event':
        return this.note(what.value);
      case 'hands':
        this.hands = what.value;
    }
  }

  /** A new connection: of the same run the pictures so far stay. A second hello on a connection: another run began. */
  private greet(hello: Hello): void {
    if (this.greeted || hello.run !== this.hello?.run) {
      this.scenes.clear();
      this.newest = null;
      this.scrubbed = null;
      this.statistics = null;
      this.undos = [];
    }
    this.seeking = null;
    this.greeted = true;
    this.samples.clear();
    this.notes = [];
    this.playback.reset();
    this.undrawn = [];
    this.hello = hello;
    this.fields = fieldsOf(hello.live);
  }

  private show(scene: Scene): void {
    const nowMs = performance.now();
    if (this.scenes.last !== null && scene.step < this.scenes.last.step) this.scrubbed = null;
    if (!this.seekUnderWay) this.seeking = null; // it is there
    this.scenes.push(scene);
    this.playback.arrived(scene.step, nowMs);
    this.undrawn.push(scene.step);
    if (this.following !== undefined) return;
    if (nowMs - this.followedMs >= FOLLOW_MS) this.follow();
    else this.following = setTimeout(() => this.follow(), FOLLOW_MS);
  }

  /** Brings what follows the picture up to date. */
  private follow(): void {
    this.following = undefined;
    this.followedMs = performance.now();
    this.newest = this.scenes.last;
    if (this.newest !== null) this.fieldsFollow(this.newest.step);
  }

  private fieldsFollow(step: number): void {
    this.fields =
      this.recordedTo === null
        ? arrivedAt(this.fields, step)
        : fieldsAt(
            this.hello?.live ?? [],
            this.notes.filter(({ kind }) => kind === 'directive'),
            step,
          );
  }

  private sample(statistics: Statistics): void {
    this.samples.push({ step: Number(statistics.step), statistics });
    ++this.samplesSeen;
  }

  private note(event: Event): void {
    const note = { step: Number(event.step), kind: event.kind, text: event.text };
    this.notes = [...this.notes, note].slice(-EVENTS_KEPT);
    if (note.kind === 'directive' && this.recordedTo === null) {
      this.fields = directed(this.fields, note.text, note.step, this.scenes.last?.step ?? -1);
    }
  }
}
