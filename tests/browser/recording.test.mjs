// The page on a recording: what replays it is written here, and speaks as lukou-console does.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { after, before, beforeEach, describe, test } from 'node:test';

import { helloOf, NAMES, pictureOf, servePage } from './scripted.mjs';
import { axeFindings, decoded, encoded, launch, slideTo, stepOf, until } from './session.mjs';

const LAST = 9000;
const WEST = 'traffic.west.flow_veh_per_h';
const live = [WEST, 'traffic.south.flow_veh_per_h', 'vehicles.equipped_ratio', 'signals.preset'].map((path) => ({
  path,
  unit: '',
  initial: { [WEST]: '1800', 'signals.preset': 'PAPER', 'vehicles.equipped_ratio': '0.7' }[path] ?? '1800',
  value: path === WEST ? '300' : '1800',
  min: 0,
  max: 10800,
}));
/** A car that drives 1 m a step, lap after lap. */
const picture = (step) =>
  pictureOf(step, [{ vehicle: 4, lane: 1, equipped: true, positionM: step % 600, speedMps: 10 }]);
const group = (step) => ({ arrived: step, meanDelayS: step / 100 });

/** What answers one page. */
class Replay {
  step = 0;
  seeks = 0;
  asked = [];
  answerAfterMs = 0;
  open = 0; // requests without an answer yet
  mostOpen = 0;
  holder = 1;

  serve(socket) {
    this.socket = socket;
    socket.onMessage((bytes) => this.hear(decoded(bytes)));
    this.say('hello', { ...helloOf('recorded-1'), live, recordedTo: BigInt(LAST) });
    const directive = (step, text) => ({ step: BigInt(step), kind: 'directive', text });
    this.say('history', { events: [directive(3000, `${WEST}=600`), directive(5000, `${WEST}=300`)] });
    this.say('hands', { holder: this.holder, viewers: 1 });
    this.say('status', { phase: 'paused', granted: 0n, end: BigInt(LAST), pace: 1 });
    this.show();
  }

  say(kind, value) {
    this.socket.send(encoded(kind, value));
  }

  show() {
    const { step, seeks } = this;
    this.say('picture', picture(step));
    const figures = { all: group(step), equipped: group(step), unequipped: group(step) };
    this.say('statistics', { step: BigInt(step), ...figures, queue: NAMES.map(() => 0), arrived: [1, 2, 3, 4], seeks });
  }

  play(steps) {
    for (let i = 0; i < steps; ++i) {
      this.step += 10;
      this.show();
    }
  }

  async hear(what) {
    if (what.case !== 'request') return;
    const { number, text } = what.value;
    this.asked.push(text);
    this.mostOpen = Math.max(this.mostOpen, ++this.open);
    const seconds = text.match(/^seek ([\d.]+)$/)?.[1];
    if (this.answerAfterMs > 0) await new Promise((resolve) => setTimeout(resolve, this.answerAfterMs));
    --this.open;
    this.say('reply', {
      number,
      ok: seconds !== undefined,
      text: seconds === undefined ? 'nothing can be changed in a recording' : 'at step',
    });
    if (seconds === undefined) return;
    this.step = Math.round(Number(seconds) * 10);
    ++this.seeks;
    this.show();
  }
}

let browser;
let server;
before(async () => {
  browser = await launch();
  server = await servePage();
});
after(async () => {
  server?.close();
  await browser?.close();
});

describe('a recording', { timeout: 100_000 }, () => {
  let replay, page, context, errors, bar;
  beforeEach(async () => {
    await context?.close();
    replay = new Replay();
    context = await browser.newContext({ viewport: { width: 1280, height: 720 }, locale: 'en', acceptDownloads: true });
    page = await context.newPage();
    errors = [];
    page.on('pageerror', (error) => errors.push(String(error)));
    await page.routeWebSocket(/\/ws$/, (socket) => replay.serve(socket));
    await page.goto(`http://127.0.0.1:${server.address().port}/`);
    await page.locator('#picture[data-step]').waitFor();
    bar = page.getByRole('slider', { name: 'Place in the recording' });
  });
  after(() => context?.close());
  const west = () => page.getByRole('spinbutton', { name: 'West' });
  const at = (step) => until(async () => (await stepOf(page)) === step, `step ${step}`);

  test('has one bar over all of it, and nothing that would change it', async () => {
    assert.equal(await bar.getAttribute('max'), String(LAST));
    await page.getByText('of 900.0 s, recorded').waitFor();
    for (const name of ['Live', 'Restart', 'Undo']) {
      assert.equal(await page.getByRole('button', { name }).count(), 0, name);
    }
    await page.getByText('A recording: what was set then').waitFor();
    assert.ok(await west().isDisabled());
    await page.locator('#picture').press('2');
    await page.getByText('A recording: a plan can be looked at').waitFor();
    assert.ok(await page.getByRole('button', { name: 'Apply' }).isDisabled());
    await page.locator('#picture').press('u');
    assert.deepEqual(replay.asked, []);
    assert.ok(await page.getByRole('button', { name: 'Step' }).isEnabled());
    assert.deepEqual(await axeFindings(page), []);
    await page.getByRole('button', { name: '中文' }).click();
    await page.getByText('录制的运行').first().waitFor();
    assert.deepEqual(await axeFindings(page), []);
    assert.deepEqual(errors, []);
  });

  test('is sought by the bar, and shows the values of that time', async () => {
    assert.equal(await west().inputValue(), '1800');
    await slideTo(page, bar, 0.4);
    await until(() => replay.asked.length > 0, 'a seek');
    const step = Math.round(Number(replay.asked.at(-1).slice(5)) * 10);
    assert.ok(Math.abs(step - 0.4 * LAST) < 0.02 * LAST, replay.asked.join());
    await at(step);
    await until(async () => (await west().inputValue()) === '600', 'the flow of then');
    await slideTo(page, bar, 0.8);
    await until(async () => (await west().inputValue()) === '300', 'the flow of the end');
    await bar.press('Home');
    await at(0);
    await until(async () => (await west().inputValue()) === '1800', 'the flow of the beginning');
    await page.getByRole('spinbutton', { name: 'Go to' }).fill('300');
    await page.keyboard.press('Enter');
    await at(3000);
  });

  test('goes by single steps in both directions, and by keys on the bar', async () => {
    await bar.press('PageUp');
    await until(() => replay.step > 0, 'a tenth further');
    const from = replay.step;
    await at(from);
    await page.locator('#picture').press(',');
    await at(from - 1);
    await page.locator('#picture').press('.');
    await at(from);
    await page.getByRole('button', { name: 'One picture back' }).click();
    await at(from - 1);
  });

  test('asks for one place at a time while the bar is dragged, and ends at the last', async () => {
    replay.answerAfterMs = 100;
    const box = await bar.boundingBox();
    await page.mouse.move(box.x + 20, box.y + box.height / 2);
    await page.mouse.down();
    for (let i = 1; i <= 60; ++i) await page.mouse.move(box.x + 20 + 5 * i, box.y + box.height / 2);
    const wanted = Number(await bar.inputValue());
    await page.mouse.up();
    await at(wanted);
    assert.equal(replay.mostOpen, 1);
    assert.ok(replay.asked.length < 60, `${replay.asked.length} seeks for 60 moves`);
    assert.equal(replay.asked.at(-1), `seek ${(wanted / 10).toFixed(1)}`);
  });

  test('forgets what lies beyond when it goes back, and joins nothing across a jump', async () => {
    replay.play(20); // 0 ... 200
    await at(200);
    await bar.press('End');
    await at(LAST);
    await bar.press('Home');
    await at(0);
    replay.play(5);
    await at(50);
    await page.waitForTimeout(700);
    const waiting = page.waitForEvent('download');
    await page.getByRole('button', { name: 'Save as CSV' }).click();
    const rows = readFileSync(await (await waiting).path(), 'utf8')
      .trim()
      .split('\n')
      .slice(1);
    assert.deepEqual(
      rows.map((row) => row.split(',')[0]),
      ['0.0', '1.0', '2.0', '3.0', '4.0', '5.0'],
    );
    await slideTo(page, bar, 0.5);
    await until(() => replay.step > 4000, 'the middle');
    replay.play(5);
    await page.waitForTimeout(1200);
    // The trend of what has arrived lifts its pen once, between the two stretches.
    const way = await page.locator('[data-figure=arrived] path.equipped').getAttribute('d');
    assert.equal(way.match(/M/g).length, 2, way);
  });

  test('is moved by whoever has control alone', async () => {
    replay.say('hands', { holder: 7, viewers: 2 });
    await page.getByText('Viewer 7 controls').waitFor();
    assert.ok(await bar.isDisabled());
    assert.equal(await bar.getAttribute('title'), 'Another viewer controls the replay');
    await page.locator('#picture').press(',');
    assert.deepEqual(replay.asked, []);
  });
});
