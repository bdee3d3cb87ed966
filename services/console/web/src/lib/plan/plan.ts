// A signal plan as the editor holds it, and what may be done to it. Every edit gives a new plan; none changes its input.
import type { SignalProgram } from '../../generated/console_pb';
import { LANES, RED } from '../wire/scene';

export interface Stretch {
  readonly aspect: number; // 1 red, 2 yellow, 3 green
  readonly steps: number;
}

export interface Plan {
  readonly cycle: number; // steps
  readonly offset: number; // steps
  readonly lanes: readonly (readonly Stretch[])[]; // twelve; each adds up to the cycle
}

/** Shortest stretch that an edit leaves over [steps]. */
export const LEAST_STEPS = 10;
export const LONGEST_CYCLE = 36_000;

export function planOf(program: SignalProgram): Plan {
  return {
    cycle: program.cycleSteps,
    offset: program.offsetSteps,
    lanes: program.lanes.map((lane) => joined(lane.aspect.map((aspect, i) => ({ aspect, steps: lane.steps[i] })))),
  };
}

/** Neighbours of the same aspect become one stretch, empty ones go. */
export function joined(stretches: readonly Stretch[]): Stretch[] {
  const result: Stretch[] = [];
  for (const stretch of stretches) {
    if (stretch.steps <= 0) continue;
    const last = result[result.length - 1];
    if (last !== undefined && last.aspect === stretch.aspect) {
      result[result.length - 1] = { aspect: last.aspect, steps: last.steps + stretch.steps };
    } else {
      result.push(stretch);
    }
  }
  return result;
}

/** What a lane shows `phase` steps into the cycle. */
export function aspectAt(lane: readonly Stretch[], phase: number): number {
  let left = phase;
  for (const stretch of lane) {
    if (left < stretch.steps) return stretch.aspect;
    left -= stretch.steps;
  }
  return RED;
}

/** Ends of the stretches but the last: where the aspect changes inside the cycle [steps]. */
export function edgesOf(lane: readonly Stretch[]): number[] {
  const edges: number[] = [];
  let at = 0;
  for (const stretch of lane.slice(0, -1)) edges.push((at += stretch.steps));
  return edges;
}

function withLanes(plan: Plan, lanes: Iterable<number>, change: (lane: readonly Stretch[]) => Stretch[]): Plan {
  const chosen = new Set(lanes);
  return { ...plan, lanes: plan.lanes.map((lane, i) => (chosen.has(i) ? joined(change(lane)) : lane)) };
}

/** "Set red / green / yellow behind" of the paper: from `phase` to the end of the cycle the lanes show `aspect`. */
export function setBehind(plan: Plan, lanes: Iterable<number>, phase: number, aspect: number): Plan {
  return withLanes(plan, lanes, (lane) => [...cut(lane, phase), { aspect, steps: plan.cycle - phase }]);
}

/** The first `phase` steps of a lane. */
function cut(lane: readonly Stretch[], phase: number): Stretch[] {
  const result: Stretch[] = [];
  let left = phase;
  for (const stretch of lane) {
    if (left <= 0) break;
    result.push({ aspect: stretch.aspect, steps: Math.min(left, stretch.steps) });
    left -= stretch.steps;
  }
  return result;
}

/** How far the edge `edge` of a lane may move: both neighbours keep a second, or what they have if that is less. */
export function edgeBounds(lane: readonly Stretch[], edge: number): { low: number; high: number } {
  const edges = edgesOf(lane);
  const at = edges[edge];
  const before = edge > 0 ? edges[edge - 1] : 0;
  const end = at + lane[edge + 1].steps;
  return { low: Math.min(at, before + LEAST_STEPS), high: Math.max(at, end - LEAST_STEPS) };
}

/**
 * Moves the edge that lies at `from` to `to` in each of the lanes that has one there, as far as all of them allow.
 */
export function moveEdge(plan: Plan, lanes: Iterable<number>, from: number, to: number): Plan {
  const movable = [...lanes].filter((i) => edgesOf(plan.lanes[i]).includes(from));
  let target = to;
  for (const i of movable) {
    const { low, high } = edgeBounds(plan.lanes[i], edgesOf(plan.lanes[i]).indexOf(from));
    target = Math.min(high, Math.max(low, target));
  }
  return withLanes(plan, movable, (lane) => {
    const edge = edgesOf(lane).indexOf(from);
    const change = target - from;
    return lane.map((stretch, i) => {
      if (i === edge) return { aspect: stretch.aspect, steps: stretch.steps + change };
      return i === edge + 1 ? { aspect: stretch.aspect, steps: stretch.steps - change } : stretch;
    });
  });
}

/** A longer cycle lengthens each lane's last stretch; a shorter one cuts the end off. */
export function setCycle(plan: Plan, cycle: number): Plan {
  const bounded = Math.min(LONGEST_CYCLE, Math.max(LEAST_STEPS, Math.round(cycle)));
  const grown = bounded - plan.cycle;
  const lanes = plan.lanes.map((lane) => {
    if (grown <= 0) return joined(cut(lane, bounded));
    const last = lane[lane.length - 1];
    return [...lane.slice(0, -1), { aspect: last.aspect, steps: last.steps + grown }];
  });
  return { cycle: bounded, offset: Math.min(plan.offset, bounded - 1), lanes };
}

export function setOffset(plan: Plan, offset: number): Plan {
  return { ...plan, offset: Math.min(LONGEST_CYCLE, Math.max(0, Math.round(offset))) };
}

/** All lanes like one of them. */
export function copyLane(plan: Plan, from: number, to: Iterable<number>): Plan {
  return withLanes(plan, to, () => [...plan.lanes[from]]);
}

export function equal(a: Plan, b: Plan): boolean {
  return (
    a.cycle === b.cycle &&
    a.offset === b.offset &&
    a.lanes.length === b.lanes.length &&
    a.lanes.every(
      (lane, i) =>
        lane.length === b.lanes[i].length &&
        lane.every((s, j) => s.aspect === b.lanes[i][j].aspect && s.steps === b.lanes[i][j].steps),
    )
  );
}

/** Where in its cycle a plan stands at `step`, if a cycle of it begins at `from`. */
export function phaseAt(plan: Plan, from: number, step: number): number {
  return (((step - from) % plan.cycle) + plan.cycle) % plan.cycle;
}

export const LANE_COUNT = LANES.length;

/** Plans that were, newest last; bounded. */
export class UndoStack {
  private plans: Plan[] = [];

  constructor(private readonly capacity = 100) {}

  get size(): number {
    return this.plans.length;
  }

  push(plan: Plan): void {
    const last = this.plans[this.plans.length - 1];
    if (last !== undefined && equal(last, plan)) return;
    this.plans.push(plan);
    if (this.plans.length > this.capacity) this.plans.shift();
  }

  pop(): Plan | null {
    return this.plans.pop() ?? null;
  }

  clear(): void {
    this.plans = [];
  }
}
