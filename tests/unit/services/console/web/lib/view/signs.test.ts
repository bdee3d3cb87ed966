import { Camera } from '@page/lib/view/camera';
import { Path } from '@page/lib/view/path';
import { SIGN, signPlaces } from '@page/lib/view/signs';

/** Twelve straight lanes of 500 m that end 15 m before the centre, three beside each other, right of the centre line. */
const paths = () =>
  [0, 1, 2, 3].flatMap((approach) =>
    [0, 1, 2].map((lane) => {
      const off = 1.75 + 3.5 * lane;
      const at = (m: number): [number, number] =>
        (
          [
            [m, -off],
            [off, m],
            [-m, off],
            [-off, -m],
          ] as [number, number][]
        )[approach];
      return new Path({
        $typeName: 'lukou.console.LanePath',
        name: '',
        points: [at(-515), at(-15), at(85)].map(([xM, yM]) => ({ $typeName: 'lukou.console.Point' as const, xM, yM })),
        distanceM: [0, 500, 600],
        stopLineM: 500,
      });
    }),
  );

const camera = () => {
  const made = new Camera();
  made.size = { width: 800, height: 400 };
  made.fit(50); // 4 px a metre
  return made;
};

describe('the signs of the approaches', () => {
  it('hang over the middle lane, at the edges of the picture, with their arrows towards the junction', () => {
    const [west, south, east, north] = signPlaces(camera(), paths());
    const left = SIGN.halfWidth + SIGN.edge;
    const top = SIGN.halfHeight + SIGN.edge;
    expect(west).toEqual({ approach: 0, x: left, y: 200 + 5.25 * 4, turnDeg: 0 });
    expect(south).toEqual({ approach: 1, x: 400 + 5.25 * 4, y: 400 - top, turnDeg: -90 });
    expect(east).toEqual({ approach: 2, x: 800 - left, y: 200 - 5.25 * 4, turnDeg: 180 });
    expect(north).toEqual({ approach: 3, x: 400 - 5.25 * 4, y: top, turnDeg: 90 });
  });

  it('stand at the entrance when that is in sight', () => {
    const far = camera();
    far.fit(2000); // 0.1 px a metre
    const west = signPlaces(far, paths()).find(({ approach }) => approach === 0)!;
    expect(west.x).toBeCloseTo(400 - 51.5, 6);
  });

  it('are gone with an approach that is out of sight', () => {
    const moved = camera();
    moved.xM = -300;
    expect(signPlaces(moved, paths()).map(({ approach }) => approach)).toEqual([0]);
    expect(signPlaces(moved, [])).toEqual([]);
  });
});
