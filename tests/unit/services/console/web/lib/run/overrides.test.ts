import { overridesIn } from '@page/lib/run/overrides';
import type { Row } from '@page/lib/run/series';

/** Counts: limit, guard, following, light, driver. */
const row = (step: number, ...overridden: number[]): Row => ({ step, statistics: { overridden } }) as unknown as Row;

describe('overrides', () => {
  it('are what the counts have grown by, the gravest rule first, and not that of following', () => {
    const rows = [row(0, 0, 0, 0, 0, 0), row(100, 2, 1, 50, 0, 0), row(200, 2, 1, 90, 0, 0), row(300, 2, 1, 90, 7, 0)];
    expect(overridesIn(rows, 100)).toEqual([
      {
        from: 0,
        to: 100,
        changed: [
          ['guard', 1],
          ['limit', 2],
        ],
      },
      { from: 200, to: 300, changed: [['light', 7]] },
    ]);
  });

  it('of samples that lie close together are one stretch, the last one as long as it is', () => {
    const rows = [0, 40, 80, 120, 160].map((step) => row(step, step / 10, 0, 0, 0, 0));
    expect(overridesIn(rows, 100)).toEqual([
      { from: 0, to: 120, changed: [['limit', 12]] },
      { from: 120, to: 160, changed: [['limit', 4]] },
    ]);
  });

  it('join nothing across a jump of a recording', () => {
    const gap: Row = { step: 150, statistics: null };
    const rows = [
      row(0, 1, 0, 0, 0, 0),
      row(50, 2, 0, 0, 0, 0),
      gap,
      row(900, 30, 0, 0, 0, 0),
      row(950, 31, 0, 0, 0, 0),
    ];
    expect(overridesIn(rows, 100).map(({ from, to }) => [from, to])).toEqual([
      [0, 50],
      [900, 950],
    ]);
  });

  it('of a server that does not count them are none', () => {
    expect(overridesIn([row(0), row(100)], 10)).toEqual([]);
  });
});
