import { findingsOf, greenSpells, HARD, PERMITTED, refused } from '@page/lib/plan/checks';
import { setBehind, type Plan } from '@page/lib/plan/plan';

const RED = 1;
const YELLOW = 2;
const GREEN = 3;
const WC = 1;
const SC = 4;
const EL = 6;

/** WC crosses SC, and EL turns left against it. */
function conflicts(): Uint8Array {
  const matrix = new Uint8Array(144);
  for (const [a, b, kind] of [
    [WC, SC, HARD],
    [WC, EL, PERMITTED],
  ]) {
    matrix[a * 12 + b] = kind;
    matrix[b * 12 + a] = kind;
  }
  return matrix;
}

/** West and east green and yellow in the first half, the others in the second. */
function plan(): Plan {
  const first = [
    { aspect: GREEN, steps: 420 },
    { aspect: YELLOW, steps: 30 },
    { aspect: RED, steps: 450 },
  ];
  const second = [
    { aspect: RED, steps: 460 },
    { aspect: GREEN, steps: 400 },
    { aspect: YELLOW, steps: 30 },
    { aspect: RED, steps: 10 },
  ];
  const isFirst = (i: number) => i < 3 || (i >= 6 && i < 9);
  return { cycle: 900, offset: 0, lanes: Array.from({ length: 12 }, (_, i) => (isFirst(i) ? first : second)) };
}

const kinds = (p: Plan) => findingsOf(p, conflicts()).map((finding) => finding.kind);

describe('the check of a plan', () => {
  it('finds nothing but the permitted left turn in a plan with yellow and a second between the streams', () => {
    expect(findingsOf(plan(), conflicts())).toEqual([{ kind: 'permitted', a: 'WC', b: 'EL', from: 0, to: 450 }]);
    expect(refused(findingsOf(plan(), conflicts()))).toBe(false);
  });

  it('says from when to when crossing streams may go together, yellow counted', () => {
    const crossing = setBehind(plan(), [SC], 440, GREEN); // WC has yellow until 450
    expect(findingsOf(crossing, conflicts())[0]).toEqual({ kind: 'hard', a: 'WC', b: 'SC', from: 440, to: 450 });
    expect(refused(findingsOf(crossing, conflicts()))).toBe(true);
  });

  it('counts crossing pairs with less than a second between them, over the end of the cycle too', () => {
    // SC green up to the end of the cycle, WC from its beginning: nothing between them.
    const close = setBehind(plan(), [SC], 460, GREEN);
    const found = findingsOf(close, conflicts()).find((finding) => finding.kind === 'no_clearance');
    expect(found).toEqual({ kind: 'no_clearance', pairs: 1, a: 'WC', b: 'SC', gap: 0 });
  });

  it('points out lanes without green, with little green, and without yellow', () => {
    expect(kinds(setBehind(plan(), [0], 0, RED))).toContain('never_green');
    const short = setBehind(setBehind(plan(), [0], 40, YELLOW), [0], 70, RED);
    expect(findingsOf(short, conflicts())).toContainEqual({ kind: 'short_green', lane: 'WL', steps: 40 });
    expect(findingsOf(setBehind(plan(), [0, 2], 420, RED), conflicts())).toContainEqual({
      kind: 'no_yellow',
      lanes: 2,
    });
  });

  it('takes a green over the end of the cycle as one', () => {
    const lane = [
      { aspect: GREEN, steps: 20 },
      { aspect: RED, steps: 800 },
      { aspect: GREEN, steps: 80 },
    ];
    expect(greenSpells(lane)).toEqual([100]);
  });

  it('says nothing of conflicts that it was not told', () => {
    expect(findingsOf(plan(), new Uint8Array())).toEqual([]);
  });
});
