// What is wrong, or worth knowing, about a plan, before it is sent. The server's own check is the judge; this one answers while
// the user still drags.
import { GREEN, LANES, RED, YELLOW } from '../wire/scene';
import { aspectAt, edgesOf, type Plan } from './plan';

export const NO_CONFLICT = 0;
export const PERMITTED = 1;
export const HARD = 2;

/** Shorter greens than this are pointed out [steps]: people and queues need some time to start. */
export const SHORT_GREEN = 50;
/** A yellow shorter than this is pointed out [steps]: 3 s, the usual value at 50 and 60 km/h. */
export const SHORT_YELLOW = 30;

export type Finding =
  | { kind: 'hard' | 'permitted'; a: string; b: string; from: number; to: number }
  | { kind: 'no_clearance'; pairs: number; a: string; b: string; gap: number }
  | { kind: 'short_green'; lane: string; steps: number }
  | { kind: 'never_green'; lane: string }
  | { kind: 'no_yellow'; lanes: number };

/** `conflicts`: 144 octets, row by row; empty if not known. */
export function findingsOf(plan: Plan, conflicts: Uint8Array): Finding[] {
  return [...conflictFindings(plan, conflicts), ...clearanceFindings(plan, conflicts), ...laneFindings(plan)];
}

export function refused(findings: readonly Finding[]): boolean {
  return findings.some((finding) => finding.kind === 'hard');
}

/** Every instant of the cycle at which some lane changes, in order, 0 and the cycle's end included. */
function instants(plan: Plan): number[] {
  const all = new Set([0, plan.cycle]);
  for (const lane of plan.lanes) for (const edge of edgesOf(lane)) all.add(edge);
  return [...all].sort((a, b) => a - b);
}

function conflictFindings(plan: Plan, conflicts: Uint8Array): Finding[] {
  const findings: Finding[] = [];
  const times = instants(plan);
  forPairs(plan, conflicts, (i, j, kind) => {
    let from = -1;
    for (const at of times) {
      const both = at < plan.cycle && aspectAt(plan.lanes[i], at) !== RED && aspectAt(plan.lanes[j], at) !== RED;
      if (both && from < 0) from = at;
      if (!both && from >= 0) {
        findings.push({ kind: kind === HARD ? 'hard' : 'permitted', a: LANES[i], b: LANES[j], from, to: at });
        from = -1;
      }
    }
  });
  return findings.sort((a, b) => (a.kind === b.kind ? 0 : a.kind === 'hard' ? -1 : 1));
}

function forPairs(plan: Plan, conflicts: Uint8Array, visit: (i: number, j: number, kind: number) => void): void {
  const count = plan.lanes.length;
  if (conflicts.length !== count * count) return;
  for (let i = 0; i < count; ++i) {
    for (let j = i + 1; j < count; ++j) {
      const kind = conflicts[i * count + j];
      if (kind !== NO_CONFLICT) visit(i, j, kind);
    }
  }
}

/** Crossing streams of which one gets green less than a second after the other's green (or yellow) ended. */
function clearanceFindings(plan: Plan, conflicts: Uint8Array): Finding[] {
  let pairs = 0;
  let worst: { a: string; b: string; gap: number } | null = null;
  forPairs(plan, conflicts, (i, j, kind) => {
    if (kind !== HARD) return;
    const gap = Math.min(gapAfter(plan, i, j), gapAfter(plan, j, i));
    if (gap >= 10) return;
    ++pairs;
    if (worst === null || gap < worst.gap) worst = { a: LANES[i], b: LANES[j], gap };
  });
  const found = worst as { a: string; b: string; gap: number } | null;
  return found === null ? [] : [{ kind: 'no_clearance', pairs, ...found }];
}

/** Shortest time from an end of `i`'s right of way to the next begin of `j`'s green [steps]; the cycle if there is none. */
function gapAfter(plan: Plan, i: number, j: number): number {
  let least = plan.cycle;
  for (const end of ends(plan, i)) {
    for (const begin of begins(plan, j)) least = Math.min(least, (begin - end + plan.cycle) % plan.cycle);
  }
  return least;
}

function ends(plan: Plan, lane: number): number[] {
  return turning(plan, lane)
    .filter(({ before, after }) => before !== RED && after === RED)
    .map(({ at }) => at);
}

function begins(plan: Plan, lane: number): number[] {
  return turning(plan, lane)
    .filter(({ before, after }) => before === RED && after !== RED)
    .map(({ at }) => at);
}

function turning(plan: Plan, lane: number): { at: number; before: number; after: number }[] {
  const stretches = plan.lanes[lane];
  let at = 0;
  return stretches.map((stretch, k) => {
    const before = stretches[(k + stretches.length - 1) % stretches.length].aspect;
    const change = { at, before, after: stretch.aspect };
    at += stretch.steps;
    return change;
  });
}

function laneFindings(plan: Plan): Finding[] {
  const findings: Finding[] = [];
  let withoutYellow = 0;
  plan.lanes.forEach((lane, i) => {
    const greens = greenSpells(lane);
    if (greens.length === 0) findings.push({ kind: 'never_green', lane: LANES[i] });
    const shortest = Math.min(...greens, plan.cycle);
    if (greens.length > 0 && shortest < SHORT_GREEN) {
      findings.push({ kind: 'short_green', lane: LANES[i], steps: shortest });
    }
    const cutShort = turning(plan, i).some(({ before, after }) => before === GREEN && after === RED);
    const shortYellow = lane.some((s) => s.aspect === YELLOW && s.steps < SHORT_YELLOW);
    if (cutShort || shortYellow) ++withoutYellow;
  });
  if (withoutYellow > 0) findings.push({ kind: 'no_yellow', lanes: withoutYellow });
  return findings;
}

/** Lengths of a lane's greens; one that goes over the end of the cycle counts whole. */
export function greenSpells(lane: readonly { aspect: number; steps: number }[]): number[] {
  const spells = lane.filter((s) => s.aspect === GREEN).map((s) => s.steps);
  const wraps = lane.length > 1 && lane[0].aspect === GREEN && lane[lane.length - 1].aspect === GREEN;
  if (wraps) spells[0] += spells.pop() ?? 0;
  return spells;
}
