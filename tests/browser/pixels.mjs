// Where things stand on the screen, computed from what the server told the page, and what colour the page gave them.

/** Metres from the centre to the edge of the picture: stop line, 50 m, and the margin of the view. */
const reachM = (stopLineM) => (stopLineM + 50) * 1.03;

function placeOn(lane, at) {
  const { points, distanceM } = lane;
  let i = 1;
  while (i < distanceM.length - 1 && distanceM[i] < at) ++i;
  const share = (at - distanceM[i - 1]) / (distanceM[i] - distanceM[i - 1]);
  return {
    x: points[i - 1].xM + share * (points[i].xM - points[i - 1].xM),
    y: points[i - 1].yM + share * (points[i].yM - points[i - 1].yM),
  };
}

/** From metres to pixels of the picture, in the view of the last 50 m. */
export function screen(hello, box) {
  const line = placeOn(hello.lanes[0], hello.lanes[0].stopLineM);
  const scale = Math.min(box.width, box.height) / (2 * reachM(Math.max(Math.abs(line.x), Math.abs(line.y))));
  return {
    scale,
    at: ({ x, y }) => ({ x: box.width / 2 + x * scale, y: box.height / 2 - y * scale }),
  };
}

/** The cars of a picture whose whole body is in sight, with the place of a spot `backM` behind their front. */
export function carsInSight(hello, picture, box, backM) {
  const { at } = screen(hello, box);
  const cars = [];
  picture.vehicle.forEach((vehicle, i) => {
    const lane = hello.lanes[picture.lane[i]];
    const ends = [0, hello.vehicleLengthM].map((back) => at(placeOn(lane, picture.positionM[i] - back)));
    const inside = ends.every((p) => p.x > 12 && p.y > 12 && p.x < box.width - 12 && p.y < box.height - 12);
    const pastLineM = picture.positionM[i] - lane.stopLineM;
    const underLamp = pastLineM > -1 && pastLineM < 7; // the heads are drawn over the cars
    if (!inside || underLamp) return;
    cars.push({ vehicle, equipped: picture.equipped[i] !== 0, spot: at(placeOn(lane, picture.positionM[i] - backM)) });
  });
  return cars;
}

/** Where a car's message to the roadside is drawn: right of its middle. With how much of the road around it is its own. */
export function uplinkMarks(hello, picture, box) {
  const { at, scale } = screen(hello, box);
  const half = Math.max(0.75, 3.2 / scale);
  const rightM = hello.vehicleWidthM / 2 + Math.max(0.12, 0.8 / scale) + 0.5 * half;
  const marks = [];
  picture.vehicle.forEach((vehicle, i) => {
    const lane = hello.lanes[picture.lane[i]];
    const middle = picture.positionM[i] - hello.vehicleLengthM / 2;
    // Straight before the line alone: there is nobody on its right but in a lane of its own.
    if (middle > lane.stopLineM - 6) return;
    const [a, b] = [placeOn(lane, middle - 0.1), placeOn(lane, middle + 0.1)];
    const ahead = { x: (b.x - a.x) / 0.2, y: (b.y - a.y) / 0.2 };
    const spot = at({ x: (a.x + b.x) / 2 + ahead.y * rightM, y: (a.y + b.y) / 2 - ahead.x * rightM });
    const inside = spot.x > 12 && spot.y > 12 && spot.x < box.width - 12 && spot.y < box.height - 12;
    if (inside) marks.push({ vehicle, fate: picture.uplink[i], spot });
  });
  return marks;
}

/** The place of a lane's stop line. */
export function stopLine(hello, lane, box) {
  return screen(hello, box).at(placeOn(hello.lanes[lane], hello.lanes[lane].stopLineM));
}

/** Colours of the upper canvas at some places: [r, g, b, a] each; and how many of its pixels have about one of `count`ed colours. */
export function coloursAt(page, places, counted = []) {
  return page.evaluate(
    ([spots, wanted]) => {
      const canvas = document.getElementById('picture');
      const ratio = canvas.width / canvas.clientWidth;
      const context = canvas.getContext('2d');
      const colours = spots.map(({ x, y }) => [
        ...context.getImageData(Math.round(x * ratio), Math.round(y * ratio), 1, 1).data,
      ]);
      const all = context.getImageData(0, 0, canvas.width, canvas.height).data;
      const counts = wanted.map(([r, g, b]) => {
        let n = 0;
        for (let i = 0; i < all.length; i += 4) {
          if (all[i + 3] > 200 && Math.abs(all[i] - r) + Math.abs(all[i + 1] - g) + Math.abs(all[i + 2] - b) < 24) ++n;
        }
        return n / (ratio * ratio);
      });
      return { colours, counts };
    },
    [places, counted],
  );
}

/** Colours of the light theme. */
export const EQUIPPED = [0x1f, 0x5f, 0xbf];
export const UNEQUIPPED = [0xe2, 0x56, 0x2b];
export const ADVICE = [0x0b, 0x8f, 0x8a];
export const LOST = [0x8a, 0x1f, 0xa8];
export const RED = [0xf0, 0x45, 0x3a];
export const YELLOW = [0xf5, 0xb9, 0x21];
export const GREEN = [0x35, 0xc4, 0x6f];

export const near = (colour, wanted) => wanted.every((c, i) => Math.abs(colour[i] - c) <= 12) && colour[3] > 200;
