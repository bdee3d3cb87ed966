import { FASTEST, neighbour, paceAt, placeOf, SLOWEST } from '@page/lib/run/speed';

describe('the speeds', () => {
  it('go from the slowest to as fast as possible and stop there', () => {
    expect([0.1, 1, 10, 100, 0].map((pace) => neighbour(pace, 1))).toEqual(['slow', 'medium', 'fast', 'max', 'max']);
    expect([0.1, 1, 10, 100, 0].map((pace) => neighbour(pace, -1))).toEqual([
      'very-slow',
      'very-slow',
      'slow',
      'medium',
      'fast',
    ]);
  });

  it('lie on the slider by powers of ten, as fast as possible at its end', () => {
    expect([0.1, 1, 10, 100, 0].map(placeOf)).toEqual([-1, 0, 1, 2, FASTEST]);
    expect(placeOf(0.01)).toBe(SLOWEST);
    expect(placeOf(1e6)).toBe(FASTEST);
    expect([-1, -0.6, 0, 1.55, 2.95, 3].map(paceAt)).toEqual(['0.1', '0.25', '1', '35', '890', 'max']);
  });

  it('find the next preset from a free speed', () => {
    expect([neighbour(25, 1), neighbour(25, -1)]).toEqual(['fast', 'medium']);
  });
});
