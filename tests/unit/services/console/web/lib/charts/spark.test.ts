import { peakOf, sparkPath, thinned, type Point } from '@page/lib/charts/spark';

const points = (...values: (number | null)[]): Point[] => values.map((value, at) => ({ at, value }));

describe('a spark', () => {
  it('goes from the left to the right edge, from zero at the bottom to the peak at the top', () => {
    expect(sparkPath(points(0, 5, 10), 10, 60, 20)).toBe('M0.0 20.0L30.0 10.0L60.0 0.0');
  });

  it('lifts the pen where there is no value', () => {
    expect(sparkPath(points(0, null, 10, 10), 10, 60, 20)).toBe('M0.0 20.0M40.0 0.0L60.0 0.0');
  });

  it('is nothing without points, and lies still with one', () => {
    expect(sparkPath([], 1, 60, 20)).toBe('');
    expect(sparkPath(points(1), 1, 60, 20)).toBe('M0.0 0.0');
  });

  it('shares its peak with the lines beside it', () => {
    expect(peakOf([points(1, 7), points(3, null)])).toBe(7);
    expect(peakOf([points(0, 0)])).toBeGreaterThan(0);
  });

  it('takes few of many points, the newest among them', () => {
    const few = thinned(
      Array.from({ length: 101 }, (_, i) => i),
      50,
    );
    expect(few.length).toBeLessThanOrEqual(50);
    expect(few[few.length - 1]).toBe(100);
  });
});
