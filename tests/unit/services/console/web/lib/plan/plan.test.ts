import {
  aspectAt,
  copyLane,
  edgeBounds,
  edgesOf,
  equal,
  joined,
  moveEdge,
  phaseAt,
  setBehind,
  setCycle,
  setOffset,
  UndoStack,
  type Plan,
} from '@page/lib/plan/plan';

const RED = 1;
const YELLOW = 2;
const GREEN = 3;

/** 90 s: lanes 0 ... 5 green for 45 s, then lanes 6 ... 11. */
function twoPhases(): Plan {
  const first = [
    { aspect: GREEN, steps: 450 },
    { aspect: RED, steps: 450 },
  ];
  const second = [
    { aspect: RED, steps: 450 },
    { aspect: GREEN, steps: 450 },
  ];
  return { cycle: 900, offset: 0, lanes: Array.from({ length: 12 }, (_, i) => (i < 6 ? first : second)) };
}

const sum = (lane: Plan['lanes'][number]) => lane.reduce((steps, s) => steps + s.steps, 0);

describe('a signal plan', () => {
  it('joins neighbours of one aspect and drops empty stretches', () => {
    const lane = [
      { aspect: RED, steps: 10 },
      { aspect: RED, steps: 5 },
      { aspect: GREEN, steps: 0 },
      { aspect: RED, steps: 1 },
    ];
    expect(joined(lane)).toEqual([{ aspect: RED, steps: 16 }]);
  });

  it('shows an aspect up to the step before its end', () => {
    const lane = twoPhases().lanes[0];
    expect([aspectAt(lane, 0), aspectAt(lane, 449), aspectAt(lane, 450), aspectAt(lane, 899)]).toEqual([
      GREEN,
      GREEN,
      RED,
      RED,
    ]);
  });

  it('is set behind the time line in the chosen lanes only', () => {
    const plan = setBehind(twoPhases(), [0, 6], 420, YELLOW);
    expect(plan.lanes[0]).toEqual([
      { aspect: GREEN, steps: 420 },
      { aspect: YELLOW, steps: 480 },
    ]);
    expect(plan.lanes[6]).toEqual([
      { aspect: RED, steps: 420 },
      { aspect: YELLOW, steps: 480 },
    ]);
    expect(plan.lanes[1]).toEqual(twoPhases().lanes[1]);
  });

  it('becomes one stretch when set behind its beginning', () => {
    expect(setBehind(twoPhases(), [3], 0, RED).lanes[3]).toEqual([{ aspect: RED, steps: 900 }]);
  });

  it('keeps the cycle when an edge moves', () => {
    const plan = moveEdge(twoPhases(), [0], 450, 380);
    expect(edgesOf(plan.lanes[0])).toEqual([380]);
    expect(sum(plan.lanes[0])).toBe(900);
  });

  it('lets no edge pass its neighbours: a second stays on either side', () => {
    const plan = setBehind(twoPhases(), [0], 600, YELLOW); // edges at 450 and 600
    expect(edgeBounds(plan.lanes[0], 0)).toEqual({ low: 10, high: 590 });
    expect(edgesOf(moveEdge(plan, [0], 450, 5000).lanes[0])).toEqual([590, 600]);
    expect(edgesOf(moveEdge(plan, [0], 450, -5).lanes[0])).toEqual([10, 600]);
  });

  it('moves an edge in all chosen lanes that have one there, as far as all allow', () => {
    const plan = setBehind(twoPhases(), [0], 500, YELLOW); // lane 0 may go up to 490
    const moved = moveEdge(plan, [0, 1, 2], 450, 700);
    expect(edgesOf(moved.lanes[0])).toEqual([490, 500]);
    expect(edgesOf(moved.lanes[1])).toEqual([490]);
    expect(edgesOf(moved.lanes[2])).toEqual([490]);
    expect(moved.lanes[3]).toEqual(plan.lanes[3]);
  });

  it('gives a longer cycle to the last stretch and cuts a shorter one off', () => {
    expect(setCycle(twoPhases(), 1000).lanes[0]).toEqual([
      { aspect: GREEN, steps: 450 },
      { aspect: RED, steps: 550 },
    ]);
    const shorter = setCycle(twoPhases(), 400);
    expect(shorter.lanes[0]).toEqual([{ aspect: GREEN, steps: 400 }]);
    expect(shorter.lanes.map(sum)).toEqual(Array(12).fill(400));
  });

  it('keeps cycle and offset within what the scenario allows', () => {
    expect(setCycle(twoPhases(), 1).cycle).toBe(10);
    expect(setCycle(twoPhases(), 1e9).cycle).toBe(36_000);
    expect(setOffset(twoPhases(), -3).offset).toBe(0);
  });

  it('is copied from one lane to others', () => {
    const plan = copyLane(twoPhases(), 0, [6, 7]);
    expect([plan.lanes[6], plan.lanes[7]]).toEqual([plan.lanes[0], plan.lanes[0]]);
    expect(plan.lanes[8]).toEqual(twoPhases().lanes[8]);
  });

  it('knows where in its cycle a step lies, also before its first cycle', () => {
    expect(phaseAt(twoPhases(), 1000, 1000)).toBe(0);
    expect(phaseAt(twoPhases(), 1000, 2000)).toBe(100);
    expect(phaseAt(twoPhases(), 1000, 990)).toBe(890);
  });

  it('is taken back step by step, equal plans counted once, the oldest forgotten', () => {
    const undos = new UndoStack(2);
    const plans = [800, 700, 600].map((cycle) => setCycle(twoPhases(), cycle));
    plans.forEach((plan) => undos.push(plan));
    undos.push(setCycle(twoPhases(), 600));
    expect(undos.size).toBe(2);
    expect(equal(undos.pop()!, plans[2])).toBe(true);
    expect(equal(undos.pop()!, plans[1])).toBe(true);
    expect(undos.pop()).toBeNull();
  });
});
