// The shortest way through the page: it comes up, draws what the server says, and the operator's hands reach the run.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';

import { carsInSight, coloursAt, EQUIPPED, near, RED, GREEN, stopLine, UNEQUIPPED } from './pixels.mjs';
import { axeFindings, launch, openPage, startRun, stepOf, until } from './session.mjs';

let run;
let browser;
let page;
let heard;
let errors;

before(async () => {
  run = await startRun(['--pace', '1', '--wait']);
  browser = await launch();
  ({ page, heard, errors } = await openPage(browser, run.url));
});
after(async () => {
  await browser?.close();
  await run?.end();
});

test('a run that waits stands at step 0 until Start', { timeout: 60_000 }, async () => {
  assert.equal(await stepOf(page), 0);
  await page.getByRole('button', { name: '▶ Start' }).click();
  await until(async () => (await stepOf(page)) > 5, 'the run moves');
});

test('a flow that is set before the cars come is followed by the arrivals', { timeout: 60_000 }, async () => {
  for (const side of ['South', 'North']) {
    await page.getByRole('spinbutton', { name: side }).fill('0');
    await page.getByRole('spinbutton', { name: side }).press('Enter');
  }
  const events = () => heard.events.filter(({ kind }) => kind === 'directive').map(({ text }) => text);
  await until(() => events().length >= 2, 'two directives');
  assert.ok(events().includes('traffic.south.flow_veh_per_h=0'), events().join());
});

test('the speed follows the buttons, and the clock says what it achieved', { timeout: 60_000 }, async () => {
  await page.getByRole('group', { name: 'Speed' }).getByRole('button', { name: 'Fast' }).click();
  await until(() => heard.status?.pace === 100, 'pace 100');
  await until(async () => (await stepOf(page)) > 3000, 'five minutes simulated', 30_000);
});

test('pausing with Space stops it; one step is one step', { timeout: 60_000 }, async () => {
  await page.locator('#picture').press(' ');
  await until(() => heard.status?.phase === 'paused', 'paused');
  const granted = Number(heard.status.granted);
  await until(async () => (await stepOf(page)) === granted, 'the last picture');
  await page.locator('#picture').press('.');
  await until(async () => (await stepOf(page)) === granted + 1, 'one step more');
});

test('only the approaches with a flow have new cars', () => {
  const [west, south, east, north] = heard.statistics.arrived;
  assert.ok(west > 80, `west ${west}`); // 1800 veh/h for 300 s are 150 on average
  assert.ok(east > 80, `east ${east}`);
  assert.ok(south + north < 20, `south ${south}, north ${north}`);
});

test(
  'the cars on the screen are those of the picture, blue with a unit, orange without',
  { timeout: 60_000 },
  async () => {
    await page.getByRole('group', { name: 'Intersection' }).getByRole('button', { name: 'Last 50 m' }).click();
    const box = await page.locator('#picture').boundingBox();
    // Where the run was paused is the machine's affair: on, until some cars are there.
    await page.getByRole('group', { name: 'Speed' }).getByRole('button', { name: 'Medium' }).click();
    await page.locator('#picture').press(' ');
    const inSight = () => carsInSight(heard.hello, heard.pictures.at(-1), box, 0.6);
    await until(() => heard.status?.phase === 'running' && inSight().length >= 5, 'five cars in sight', 40_000);
    await page.locator('#picture').press(' ');
    await until(() => heard.status?.phase === 'paused', 'paused');
    const step = Number(heard.status.granted);
    await until(async () => (await stepOf(page)) === step, 'the last picture');
    const picture = heard.pictures.findLast((p) => Number(p.step) === step);
    await page.waitForTimeout(300);
    const cars = carsInSight(heard.hello, picture, box, 0.6); // the bonnet: body colour
    assert.ok(cars.length >= 2, `${cars.length} cars in sight`);
    const { colours } = await coloursAt(
      page,
      cars.map((car) => car.spot),
    );
    cars.forEach((car, i) => {
      const wanted = car.equipped ? EQUIPPED : UNEQUIPPED;
      assert.ok(near(colours[i], wanted), `car ${car.vehicle}, equipped ${car.equipped}: ${colours[i]}`);
    });
    assert.ok(Number(await page.locator('#picture').getAttribute('data-cars')) >= cars.length);
  },
);

test('the stop lines have the colours of their heads', { timeout: 60_000 }, async () => {
  const picture = heard.pictures.at(-1);
  const box = await page.locator('#picture').boundingBox();
  const { colours } = await coloursAt(
    page,
    heard.hello.lanes.map((_, lane) => stopLine(heard.hello, lane, box)),
  );
  picture.heads.forEach((aspect, lane) => {
    const wanted = aspect === 3 ? GREEN : RED; // the paper's plan has no yellow
    assert.ok(near(colours[lane], wanted), `${heard.hello.lanes[lane].name} shows ${aspect}: ${colours[lane]}`);
  });
});

test(
  'a plan that lets crossing streams go together is refused in words, a good one is taken',
  { timeout: 60_000 },
  async () => {
    await page.getByRole('tab', { name: 'Signals' }).click();
    const panel = page.getByRole('tabpanel');
    await panel.locator('[data-lane=SC]').click();
    await panel.getByRole('spinbutton', { name: 'Time line' }).fill('40');
    await panel.getByRole('spinbutton', { name: 'Time line' }).press('Enter');
    await panel.getByRole('button', { name: 'Set green behind the line' }).click();
    assert.match(await panel.getByRole('list').last().innerText(), /SC.*cross|cross.*SC/);
    await panel.getByRole('button', { name: 'Apply' }).click();
    await panel.getByRole('alert').getByText('crossing streams').waitFor();
    await panel.getByRole('button', { name: 'Undo' }).click();
    await panel.getByRole('combobox').selectOption('PAPER_YELLOW');
    await panel.getByRole('button', { name: 'Apply' }).click();
    await panel.getByText('accepted').waitFor();
  },
);

test('nothing that axe-core calls serious, no error in the page', { timeout: 60_000 }, async () => {
  assert.deepEqual(await axeFindings(page), []);
  assert.deepEqual(errors, []);
});
