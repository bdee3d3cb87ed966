// The plan that is being edited, beside the one that runs.
import { equal, setCycle, setOffset, UndoStack, type Plan } from './plan';

export class Draft {
  running = $state.raw<Plan | null>(null);
  edited = $state.raw<Plan | null>(null); // null: nothing was changed, what runs is shown
  sent = $state.raw<Plan | null>(null); // accepted, not running yet
  line = $state(0); // the time line [steps into the cycle]
  undoable = $state(0);
  chosen = $state.raw<ReadonlySet<number>>(new Set());

  plan = $derived(this.edited ?? this.sent ?? this.running);
  changed = $derived(this.edited !== null);

  private readonly undos = new UndoStack();

  /** The plan that the heads follow now. */
  runs(plan: Plan): void {
    if (this.running !== null && equal(this.running, plan)) return;
    this.running = plan;
    this.sent = null; // it runs, or another change has taken its place
    if (this.edited !== null && equal(this.edited, plan)) this.edited = null;
    this.keepLine();
  }

  /** Another run has begun: what was sent went to the one before. The draft stays. */
  anotherRun(): void {
    this.sent = null;
  }

  /** Puts `plan` in the place of the draft; undo brings the one before back. */
  put(plan: Plan): void {
    const before = this.plan;
    if (before === null || equal(before, plan)) return;
    this.undos.push(before);
    this.undoable = this.undos.size;
    this.show(plan);
  }

  /** As put, for the moves in the middle of a drag: only `begin` counts for undo. */
  drag(begin: Plan, plan: Plan): void {
    if (!equal(begin, plan)) this.undos.push(begin);
    this.undoable = this.undos.size;
    this.show(plan);
  }

  undo(): void {
    const plan = this.undos.pop();
    this.undoable = this.undos.size;
    if (plan !== null) this.show(plan);
  }

  discard(): void {
    if (this.edited !== null) this.undos.push(this.edited);
    this.undoable = this.undos.size;
    this.edited = null;
    this.keepLine();
  }

  accepted(plan: Plan): void {
    this.sent = this.running !== null && equal(this.running, plan) ? null : plan;
    this.edited = null;
  }

  cycle(steps: number): void {
    if (this.plan !== null) this.put(setCycle(this.plan, steps));
  }

  offset(steps: number): void {
    if (this.plan !== null) this.put(setOffset(this.plan, steps));
  }

  moveLine(steps: number): void {
    this.line = steps;
    this.keepLine();
  }

  choose(lanes: Iterable<number>): void {
    this.chosen = new Set(lanes);
  }

  toggle(lane: number): void {
    const chosen = new Set(this.chosen);
    if (!chosen.delete(lane)) chosen.add(lane);
    this.chosen = chosen;
  }

  /** An edge that is moved takes the chosen lanes along if its lane is one of them. */
  together(lane: number): Iterable<number> {
    return this.chosen.has(lane) ? this.chosen : [lane];
  }

  private show(plan: Plan): void {
    const same = this.sent ?? this.running;
    this.edited = same !== null && equal(same, plan) ? null : plan;
    this.keepLine();
  }

  private keepLine(): void {
    const end = (this.plan?.cycle ?? 1) - 1;
    this.line = Math.min(Math.max(0, Math.round(this.line)), end);
  }
}
