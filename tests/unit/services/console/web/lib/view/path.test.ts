import { Path } from '@page/lib/view/path';

/** East for 10 m, then north for 10 m. */
const corner = () =>
  new Path({
    $typeName: 'lukou.console.LanePath',
    name: 'WL',
    points: [
      [0, 0],
      [10, 0],
      [10, 10],
    ].map(([xM, yM]) => ({ $typeName: 'lukou.console.Point' as const, xM, yM })),
    distanceM: [0, 10, 20],
    stopLineM: 8,
  });

describe('a path', () => {
  it('places a car by the metres it has driven', () => {
    expect(corner().place(4)).toEqual({ xM: 4, yM: 0 });
    expect(corner().place(13)).toEqual({ xM: 10, yM: 3 });
  });

  it('goes on straight before its entrance and beyond its end', () => {
    expect(corner().place(-4.5)).toEqual({ xM: -4.5, yM: 0 });
    expect(corner().place(25)).toEqual({ xM: 10, yM: 15 });
  });

  it('knows its direction', () => {
    expect(corner().direction(15).yM).toBeCloseTo(1, 9);
    expect(corner().direction(5).xM).toBeCloseTo(1, 9);
  });

  it('gives a stretch with the points inside it', () => {
    expect(corner().stretch(8, 12)).toEqual([
      { xM: 8, yM: 0 },
      { xM: 10, yM: 0 },
      { xM: 10, yM: 2 },
    ]);
  });
});
