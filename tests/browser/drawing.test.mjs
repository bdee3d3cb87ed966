// What the page draws of a known state, pixel by pixel.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';

import { coloursAt, EQUIPPED, GREEN, near, RED, screen, stopLine, UNEQUIPPED, YELLOW } from './pixels.mjs';
import { helloOf, NAMES, pictureOf, servePage } from './scripted.mjs';
import { encoded, launch, until } from './session.mjs';

let browser, server, page, socket, box;
const hello = helloOf('drawn-1');
before(async () => {
  server = await servePage();
  browser = await launch();
  page = await browser.newPage({ viewport: { width: 1280, height: 720 }, colorScheme: 'light' });
  await page.routeWebSocket(/\/ws$/, (opened) => {
    socket = opened;
    say('hello', hello);
    say('hands', { holder: 0, viewers: 1 });
    say('status', { phase: 'paused', granted: 0n, end: 9000n, pace: 1 });
    say('picture', pictureOf(0, []));
  });
  await page.goto(`http://127.0.0.1:${server.address().port}/`);
  await page.locator('#picture[data-step="0"]').waitFor();
  box = await page.locator('#picture').boundingBox();
});
after(async () => {
  await browser?.close();
  server?.close();
});

const say = (kind, value) => socket.send(encoded(kind, value));
async function show(step, cars, heads) {
  say('picture', pictureOf(step, cars, heads));
  await until(async () => (await page.locator('#picture').getAttribute('data-step')) === String(step), `step ${step}`);
  await page.waitForTimeout(700); // smooth cars have come to rest
}

/** Keeps the pixels as they are, to tell what a later picture adds. */
const keep = () =>
  page.evaluate(() => {
    const canvas = document.getElementById('picture');
    window.kept = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
  });

/** Connected patches of pixels that differ from those kept: the middle and size of each [CSS px]. */
const patches = () =>
  page.evaluate(() => {
    const canvas = document.getElementById('picture');
    const { width, height } = canvas;
    const ratio = width / canvas.clientWidth;
    const { data } = canvas.getContext('2d').getImageData(0, 0, width, height);
    const differs = new Uint8Array(width * height);
    for (let i = 0; i < differs.length; ++i) {
      for (let c = 0; c < 4; ++c) if (Math.abs(data[4 * i + c] - window.kept[4 * i + c]) > 30) differs[i] = 1;
    }
    const found = [];
    for (let first = 0; first < differs.length; ++first) {
      if (!differs[first]) continue;
      const open = [first];
      differs[first] = 0;
      let [n, x, y] = [0, 0, 0];
      while (open.length > 0) {
        const at = open.pop();
        const column = at % width;
        ++n;
        x += column;
        y += (at - column) / width;
        for (const next of [column > 0 ? at - 1 : at, column < width - 1 ? at + 1 : at, at - width, at + width]) {
          if (differs[next] === 1) {
            differs[next] = 0;
            open.push(next);
          }
        }
      }
      if (n > 4) found.push({ x: x / n / ratio, y: y / n / ratio, pixels: n / (ratio * ratio) });
    }
    return found;
  });

/** Cars on all twelve lanes, 6 m apart at least, before the line: equipped where their number is even. */
const CARS = NAMES.flatMap((_, lane) =>
  [5, 15, 27].slice(0, 1 + (lane % 3)).map((back, i) => ({
    vehicle: 10 * lane + i,
    lane,
    equipped: (lane + i) % 2 === 0,
    positionM: 500 - back,
    speedMps: 10,
  })),
);

/** A place of a car on the screen, `backM` behind its front. The lanes here are straight. */
function spotOf({ lane, positionM }, backM) {
  const { points, distanceM } = hello.lanes[lane];
  const share = (positionM - backM - distanceM[0]) / (distanceM[1] - distanceM[0]);
  const between = (a, b) => a + share * (b - a);
  return screen(hello, box).at({ x: between(points[0].xM, points[1].xM), y: between(points[0].yM, points[1].yM) });
}

test('as many cars are drawn as there are, each where it is, at true size', { timeout: 60_000 }, async () => {
  await show(1, []);
  await keep();
  assert.deepEqual(await patches(), []);
  await show(2, CARS);
  const found = await patches();
  assert.equal(found.length, 24);
  const { scale } = screen(hello, box);
  for (const car of CARS) {
    const middle = spotOf(car, 2.25);
    const there = found.filter(({ x, y }) => Math.hypot(x - middle.x, y - middle.y) < 0.5 * scale + 1);
    assert.equal(there.length, 1, `car ${car.vehicle}`);
    const body = 4.5 * 1.8 * scale * scale;
    assert.ok(there[0].pixels > 0.75 * body && there[0].pixels < 1.25 * body, `${there[0].pixels} px for ${body}`);
  }
});

test('equipped cars are blue with a white mark on the roof, others orange without', { timeout: 60_000 }, async () => {
  const { colours: bonnets } = await coloursAt(
    page,
    CARS.map((car) => spotOf(car, 0.7)),
  );
  const { colours: roofs } = await coloursAt(
    page,
    CARS.map((car) => spotOf(car, 0.58 * 4.5)),
  );
  CARS.forEach(({ vehicle, equipped }, i) => {
    assert.ok(near(bonnets[i], equipped ? EQUIPPED : UNEQUIPPED), `bonnet of ${vehicle}: ${bonnets[i]}`);
    assert.ok(near(roofs[i], equipped ? [255, 255, 255] : UNEQUIPPED), `roof of ${vehicle}: ${roofs[i]}`);
  });
});

test('each stop line has the colour of its head', { timeout: 60_000 }, async () => {
  const heads = NAMES.map((_, lane) => 1 + (lane % 3));
  await show(3, [], heads);
  const { colours } = await coloursAt(
    page,
    NAMES.map((_, lane) => stopLine(hello, lane, box)),
  );
  heads.forEach((aspect, lane) => {
    assert.ok(near(colours[lane], [RED, YELLOW, GREEN][aspect - 1]), `${NAMES[lane]}: ${colours[lane]}`);
  });
});
