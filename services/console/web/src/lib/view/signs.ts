// Where on the picture the sign of an approach hangs: over the lanes that lead to the junction, as far out as is in sight.
import { APPROACHES } from '../wire/scene';
import type { Camera } from './camera';
import type { Path, Place } from './path';

export interface SignPlace {
  readonly approach: number; // 0 west, 1 south, 2 east, 3 north
  readonly x: number; // its middle [px]
  readonly y: number;
  readonly turnDeg: number; // of an arrow to the right, clockwise, so that it points the way that cars go
}

/** Half of a sign, and its distance from the edge of the picture [px]. */
export const SIGN = { halfWidth: 29, halfHeight: 13, edge: 6 };

/** Signs of the approaches that are in sight. */
export function signPlaces(camera: Camera, paths: readonly Path[]): SignPlace[] {
  const places: SignPlace[] = [];
  APPROACHES.forEach((_, approach) => {
    const middle = paths[3 * approach + 1];
    if (middle === undefined) return;
    const from = onScreen(camera, middle.place(middle.stopLineM));
    const to = onScreen(camera, middle.place(0));
    const out = lastInside(camera, from, to);
    if (out === null) return;
    const turnDeg = (Math.atan2(from.y - to.y, from.x - to.x) * 180) / Math.PI;
    places.push({ approach, ...out, turnDeg: Math.round(turnDeg) });
  });
  return places;
}

interface Spot {
  x: number;
  y: number;
}

function onScreen(camera: Camera, { xM, yM }: Place): Spot {
  return { x: camera.toScreenX(xM), y: camera.toScreenY(yM) };
}

/** The point of a straight way that is nearest to its end, among those where a whole sign is in the picture. */
function lastInside({ size }: Camera, from: Spot, to: Spot): Spot | null {
  const left = SIGN.halfWidth + SIGN.edge;
  const top = SIGN.halfHeight + SIGN.edge;
  let low = 0;
  let high = 1;
  for (const [at, by, least, most] of [
    [from.x, to.x - from.x, left, size.width - left],
    [from.y, to.y - from.y, top, size.height - top],
  ]) {
    if (by === 0) {
      if (at < least || at > most) return null;
      continue;
    }
    const ends = [(least - at) / by, (most - at) / by].sort((a, b) => a - b);
    low = Math.max(low, ends[0]);
    high = Math.min(high, ends[1]);
  }
  return low > high ? null : { x: from.x + (to.x - from.x) * high, y: from.y + (to.y - from.y) * high };
}
