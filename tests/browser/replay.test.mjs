// A recorded run in the real page: played, sought, and compared with the tables of the run.
import assert from 'node:assert/strict';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { launch, openPage, runToEnd, startReplay, stepOf, until } from './session.mjs';

let folder;
let browser;
let replay;
let viewer;

before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'lukou-replay-'));
  const result = join(folder, 'run');
  await runToEnd(['--mode', 'in-process', '--duration', '400', '--set', 'record.log=FULL', '--out', result]);
  replay = await startReplay(result);
  browser = await launch();
  viewer = await openPage(browser, replay.url);
});
after(async () => {
  await browser?.close();
  await replay?.end();
  rmSync(folder, { recursive: true, force: true });
});

/** A table of the run as rows of numbers and words by column. */
function table(name) {
  const [head, ...lines] = readFileSync(join(folder, 'run', name), 'utf8')
    .trimEnd()
    .split('\n');
  const columns = head.split(',');
  return lines.map((line) => Object.fromEntries(line.split(',').map((cell, i) => [columns[i], cell])));
}

test('says that it is a recording, plays, and pauses with Space', { timeout: 60_000 }, async () => {
  const { page, heard } = viewer;
  assert.equal(Number(heard.hello.recordedTo), 4000);
  const begin = await stepOf(page);
  await until(async () => (await stepOf(page)) > begin + 5, 'half a second played');
  await page.getByRole('button', { name: 'Take control' }).click();
  await page.locator('#picture').press(' ');
  await until(() => heard.status.phase === 'paused', 'pause');
});

test('scrubbed to 300 s the cars stand where the tables say', { timeout: 60_000 }, async () => {
  const { page, heard } = viewer;
  const slider = page.locator('input[type="range"][max="4000"]');
  await slider.fill('3000');
  await until(async () => (await stepOf(page)) === 3000, 'step 3000');
  const picture = await until(() => heard.picture.step === 3000n && heard.picture, 'its picture');

  const statistics = await until(() => heard.statistics.step === 3000n && heard.statistics, 'its figures');
  const road = table('road.csv')[2999];
  const stop = table('stop.csv')[2999];
  assert.equal(road.time_s, '300.0');
  assert.equal(statistics.all.left, Number(road.left_system_total));
  assert.equal(statistics.all.stops, Number(stop.system_total));
  assert.equal(statistics.all.standing, Number(stop.standing_now));

  // On the road at 300 s: who came before and left later. Cars on the road at the end have no row.
  const there = new Set(picture.vehicle);
  let passed = 0;
  for (const car of table('car.csv')) {
    const expected = Number(car.entered_s) <= 300 && Number(car.left_s) > 300;
    assert.equal(there.has(Number(car.vehicle)), expected, `car ${car.vehicle}`);
    passed += expected ? 1 : 0;
  }
  assert.ok(passed > 20, `${passed} cars`);

  // Who stands then has stood at this place since its stop began, but for the last half metre.
  const lines = heard.hello.lanes.map((lane) => lane.stopLineM);
  const lanes = heard.hello.lanes.map((lane) => lane.name);
  let stood = 0;
  for (const stop of table('stops.csv')) {
    if (Number(stop.began_s) > 298 || Number(stop.time_s) <= 300) continue;
    const i = picture.vehicle.indexOf(Number(stop.vehicle));
    if (picture.speedMps[i] > 0) continue; // it has begun to go
    const distance = lines[picture.lane[i]] - picture.positionM[i];
    assert.equal(lanes[picture.lane[i]], stop.lane);
    assert.ok(Number(stop.distance_m) - distance >= -0.001, `${distance} ${stop.distance_m}`);
    assert.ok(Number(stop.distance_m) - distance < 1.5, `car ${stop.vehicle}: ${distance} ${stop.distance_m}`);
    stood += 1;
  }
  assert.ok(stood > 0, 'somebody stands at 300 s');
});

test('goes back, and follows a car at another speed', { timeout: 60_000 }, async () => {
  const { page, heard } = viewer;
  await page.locator('input[type="range"][max="4000"]').fill('1000');
  await until(async () => (await stepOf(page)) === 1000, 'step 1000');
  const fast = page.getByRole('button', { name: 'Medium' });
  await fast.click();
  await page.locator('#picture').press(' ');
  await until(async () => (await stepOf(page)) > 1200, '20 s at ten times real time', 10_000);
  assert.equal(heard.status.pace, 10);
});

test('nothing can be changed in it, and the page has no error', { timeout: 60_000 }, async () => {
  const { page, errors } = viewer;
  const flow = page.getByRole('spinbutton', { name: 'West' });
  assert.ok(await flow.isDisabled());
  assert.deepEqual(errors, []);
});
