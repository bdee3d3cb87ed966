import { neighbour } from '@page/lib/run/speed';

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

  it('find the next preset from a free speed', () => {
    expect([neighbour(25, 1), neighbour(25, -1)]).toEqual(['fast', 'medium']);
  });
});
