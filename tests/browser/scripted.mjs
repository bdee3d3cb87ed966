// What a server says that is written here instead of lukou-console: a known state for the page to draw.
import { once } from 'node:events';
import { readFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { dirname, extname, join } from 'node:path';

import { programs } from './session.mjs';

export const NAMES = ['W', 'S', 'E', 'N'].flatMap((side) => ['L', 'C', 'R'].map((turn) => side + turn));

/** Twelve straight lanes of 500 m before the line and 100 m behind it. */
const lanes = NAMES.map((name, i) => {
  const off = 1.75 + 3.5 * (i % 3);
  const at = (m) =>
    [
      [m, -off],
      [off, m],
      [-m, off],
      [-off, -m],
    ][Math.floor(i / 3)];
  const points = [at(-515.5), at(-15.5), at(84.5)].map(([xM, yM]) => ({ xM, yM }));
  return { name, points, distanceM: [0, 500, 600], stopLineM: 500 };
});
const program = {
  cycleSteps: 900,
  lanes: NAMES.map((_, i) => ({ aspect: i % 6 < 3 ? [3, 1] : [1, 3], steps: [450, 450] })),
};

/** The first message to a page. */
export const helloOf = (run) => ({
  run,
  lanes,
  vehicleLengthM: 4.5,
  vehicleWidthM: 1.8,
  laneWidthM: 3.5,
  speedLimitMps: 16,
  stepS: 0.1,
  viewer: 1,
  seed: '1',
});

/** A step with these cars, front to back in each lane, and these heads. */
export function pictureOf(step, cars, heads = NAMES.map(() => 1)) {
  const octets = (of) => Uint8Array.from(cars, of);
  return {
    step: BigInt(step),
    vehicle: cars.map(({ vehicle }) => vehicle),
    lane: octets(({ lane }) => lane),
    equipped: octets(({ equipped }) => (equipped ? 1 : 0)),
    positionM: cars.map(({ positionM }) => positionM),
    speedMps: cars.map(({ speedMps }) => speedMps),
    accelerationMps2: cars.map(() => 0),
    commandedMps2: cars.map(() => NaN),
    state: octets(() => 0),
    guidance: octets(() => 1),
    boundBy: octets(() => 0),
    missed: octets(() => 255),
    stoodS: cars.map(() => 0),
    adviceAge: cars.map(() => -1),
    uplink: octets(() => 0),
    heardAge: cars.map(() => 1),
    heads: Uint8Array.from(heads),
    changeIn: NAMES.map(() => 10),
    nextAspect: Uint8Array.from(NAMES, () => 3),
    waiting: [0, 0, 0, 0],
    program,
  };
}

/** The files of the page, by HTTP on a free port. */
export async function servePage() {
  const folder = join(dirname(programs), 'console');
  const types = { '.js': 'text/javascript', '.css': 'text/css', '.svg': 'image/svg+xml', '.html': 'text/html' };
  const server = createServer((request, response) => {
    const { pathname } = new URL(request.url, 'http://x');
    const file = pathname === '/' ? '/index.html' : pathname;
    response.setHeader('Content-Type', types[extname(file)] ?? 'text/plain');
    response.end(readFileSync(join(folder, file)));
  });
  server.listen(0, '127.0.0.1');
  await once(server, 'listening');
  return server;
}
