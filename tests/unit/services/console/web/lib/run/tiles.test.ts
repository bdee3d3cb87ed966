import type { Statistics } from '@page/generated/console_pb';
import { differenceOf, tilesOf, trendsOf } from '@page/lib/run/tiles';

const statistics = (step: number, equipped: object, unequipped: object) =>
  ({ step: BigInt(step), all: {}, equipped, unequipped, queue: [] }) as unknown as Statistics;

describe('the figures', () => {
  it('are twelve', () => {
    expect(tilesOf(null, 0.1)).toHaveLength(12);
  });

  it('have a trend of both groups, with gaps where there is no value', () => {
    const rows = [
      { step: 10, statistics: statistics(10, { stops: 1 }, { stops: 4 }) },
      { step: 15, statistics: null },
      { step: 20, statistics: statistics(20, { stops: 2 }, {}) },
    ];
    expect(trendsOf(rows).get('stops')).toEqual({
      equipped: [
        { at: 10, value: 1 },
        { at: 15, value: null },
        { at: 20, value: 2 },
      ],
      unequipped: [
        { at: 10, value: 4 },
        { at: 15, value: null },
        { at: 20, value: null },
      ],
    });
  });

  it('are compared where they are means', () => {
    const now = statistics(10, { meanDelayS: 16, stops: 3 }, { meanDelayS: 17.5, stops: 5 });
    expect(differenceOf(now, 'meanDelay')).toBe(-1.5);
    expect(differenceOf(now, 'stops')).toBeNull();
    expect(differenceOf(now, 'meanStopTime')).toBeNull();
    expect(differenceOf(null, 'meanDelay')).toBeNull();
  });
});
