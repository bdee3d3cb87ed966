// Everything a user does with the page, against real processes.
import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, describe, test } from 'node:test';

import { carsInSight, coloursAt, EQUIPPED, UNEQUIPPED } from './pixels.mjs';
import {
  attach,
  axeFindings,
  directives,
  launch,
  memberPid,
  openPage,
  runToEnd,
  slideTo,
  startRun,
  stepOf,
  until,
} from './session.mjs';

let browser;
before(async () => (browser = await launch()));
after(async () => browser?.close());

const tab = (page, name) => page.getByRole('tab', { name }).click();
const speed = (page, name) =>
  page.getByRole('group', { name: 'Speed' }).getByRole('button', { name, exact: true }).click();

describe('flows and ratio', { timeout: 150_000 }, () => {
  let run, page, heard, close;
  before(async () => {
    run = await startRun(['--pace', '10', '--set', 'run.on_overflow=CONTINUE']);
    ({ page, heard, close } = await openPage(browser, run.url));
  });
  after(async () => {
    await close?.();
    await run?.end();
  });

  test('each flow is set by number or slider, shown as on its way and then as in force', async () => {
    const west = page.getByRole('spinbutton', { name: 'West' });
    await west.fill('3000');
    await west.press('Enter');
    await until(() => directives(heard).some(({ text }) => text === 'traffic.west.flow_veh_per_h=3000'), 'the echo');
    for (const [side, share] of [
      ['South', 0],
      ['East', 0],
      ['North', 0],
    ]) {
      await slideTo(page, page.getByRole('slider', { name: side }), share);
    }
    await until(() => directives(heard).length >= 4, 'four directives');
    await until(async () => (await page.locator('.coming').count()) === 0, 'nothing is pending any more');
    assert.equal(await page.getByRole('spinbutton', { name: 'South' }).inputValue(), '0');
  });

  test('the arrivals follow', async () => {
    const from = [...heard.statistics.arrived];
    const at = Number(heard.statistics.step);
    await until(() => Number(heard.statistics.step) > at + 1500, '150 s simulated', 40_000);
    const grown = heard.statistics.arrived.map((n, i) => n - from[i]);
    assert.ok(grown[0] > 80, `west ${grown}`); // 3000 veh/h for 150 s: 125 on average
    assert.deepEqual(grown.slice(1), [0, 0, 0]);
  });

  test('the ratio holds for cars that come from then on, and the actual share is said', async () => {
    const ratio = page.getByRole('spinbutton', { name: 'Equipped ratio' });
    await ratio.fill('0');
    await ratio.press('Enter');
    await until(() => directives(heard).some(({ text }) => text === 'vehicles.equipped_ratio=0'), 'the echo');
    const equipped = heard.statistics.equipped.arrived;
    const at = Number(heard.statistics.step);
    await until(() => Number(heard.statistics.step) > at + 1500, '150 s simulated', 40_000);
    assert.ok(heard.statistics.equipped.arrived - equipped <= 3, 'at most those of the steps under way');
    assert.match(await page.getByText('on the road now').innerText(), /\d+\s%/);
  });

  test('all four together, and a value out of range is refused with the range', async () => {
    await slideTo(page, page.getByRole('slider', { name: 'All four' }), 0.5);
    await until(() => directives(heard).filter(({ text }) => text.includes('=1800')).length === 4, 'four directives');
    const west = page.getByRole('spinbutton', { name: 'West' });
    await west.fill('99999');
    await west.press('Enter');
    await page.locator('.refusal').getByText('10800').first().waitFor();
    assert.equal(await west.inputValue(), '1800'); // what is in force
  });

  test('a reload in the middle shows the values in force and the time before', async () => {
    const step = await stepOf(page);
    await page.reload();
    await page.locator('#picture[data-step]').waitFor();
    assert.ok((await stepOf(page)) >= step);
    assert.equal(await page.getByRole('spinbutton', { name: 'Equipped ratio' }).inputValue(), '0');
    assert.ok(heard.history.samples.length > 20, `${heard.history.samples.length} samples of the time before`);
    await tab(page, 'Log');
    await page.getByText('vehicles.equipped_ratio=0').waitFor();
  });
});

describe('speeds', { timeout: 150_000 }, () => {
  test('every speed is asked for and kept; free ones and the keys too', async (t) => {
    const run = await startRun(['--pace', '1', '--duration', '200000']); // more than a busy machine does at Max meanwhile
    t.after(() => run.end());
    const { page, heard, close } = await openPage(browser, run.url);
    for (const [name, pace, lowest, highest] of [
      ['Very slow', 0.1, 0.05, 0.2],
      ['Slow', 1, 0.8, 1.2],
      ['Medium', 10, 8, 12],
      ['Fast', 100, 60, 110],
    ]) {
      await speed(page, name);
      await until(() => heard.status.pace === pace, `pace ${pace}`);
      await until(() => heard.status.paceAchieved > lowest && heard.status.paceAchieved < highest, `${name} achieved`);
    }
    await speed(page, 'Max');
    await until(() => heard.status.pace === 0 && heard.status.paceAchieved > 100, 'more than 100x');
    const slider = page.getByRole('slider', { name: 'Speed' });
    await slideTo(page, slider, 0.5); // the middle of 0.1 ... max
    await until(() => heard.status.pace > 8 && heard.status.pace < 12, 'about 10');
    await slider.press('ArrowRight'); // a twentieth of a power of ten
    await until(() => heard.status.pace > 10.5 && heard.status.pace < 13, 'a little more');
    await slider.press('End');
    await until(() => heard.status.pace === 0, 'as fast as possible at its end');
    const free = page.getByRole('spinbutton', { name: 'Other speed' });
    await free.fill('25');
    await free.press('Enter');
    await until(() => heard.status.pace === 25, 'pace 25');
    await page.locator('#picture').press('[');
    await until(() => heard.status.pace === 10, 'the preset below');
    await page.locator('#picture').press(']');
    await until(() => heard.status.pace === 100, 'the preset above');
    await close();
  });
});

describe('the signal plan', { timeout: 150_000 }, () => {
  let run, page, heard, panel, close;
  before(async () => {
    run = await startRun(['--pace', '10']);
    ({ page, heard, close } = await openPage(browser, run.url));
    await tab(page, 'Signals');
    panel = page.getByRole('tabpanel');
    await panel.locator('[data-lane=WC]').waitFor();
  });
  after(async () => {
    await close?.();
    await run?.end();
  });

  const edge = (lane) => panel.locator(`[data-edge="${lane}-0"]`);
  const valueOf = async (lane) => Number(await edge(lane).getAttribute('aria-valuenow'));

  test('an edge is dragged in whole seconds, and undone', async () => {
    const box = await edge(0).boundingBox();
    const y = box.y + box.height / 2;
    await page.mouse.move(box.x + 4, y);
    await page.mouse.down();
    await page.mouse.move(box.x - 14, y, { steps: 4 });
    await page.mouse.up();
    const moved = await valueOf(0);
    assert.ok(moved < 45 && Number.isInteger(moved), `edge at ${moved}`);
    await panel.getByRole('button', { name: 'Undo' }).click();
    assert.equal(await valueOf(0), 45);
  });

  test('arrows move an edge by a second, chosen lanes together', async () => {
    await panel.getByRole('button', { name: 'W E' }).click();
    await edge(1).focus();
    await page.keyboard.press('ArrowLeft');
    await page.keyboard.press('ArrowLeft');
    await page.keyboard.press('ArrowLeft');
    for (const lane of [0, 1, 2, 6, 7, 8]) assert.equal(await valueOf(lane), 42);
    assert.equal(await valueOf(3), 45);
  });

  test('the time line is typed, and what lies behind it is set', async () => {
    const line = panel.getByRole('spinbutton', { name: 'Time line' });
    await line.fill('41');
    await line.press('Enter');
    await panel.getByRole('button', { name: 'Set yellow behind' }).click();
    await line.fill('44');
    await line.press('Enter');
    await panel.getByRole('button', { name: 'Set red behind' }).click();
    assert.equal(await valueOf(0), 41);
    assert.equal(Number(await panel.locator('[data-edge="0-1"]').getAttribute('aria-valuenow')), 44);
  });

  test('a good plan is applied and takes effect at the start of a cycle', async () => {
    const old = heard.pictures.findLast((picture) => picture.program)?.program ?? heard.picture.program;
    assert.ok(old === undefined || old.cycleSteps === 900);
    await panel.getByRole('button', { name: 'Apply' }).click();
    await until(() => directives(heard).some(({ text }) => text.startsWith('signals.plan=')), 'the directive');
    const asked = Number(directives(heard).findLast(({ text }) => text.startsWith('signals.plan=')).step);
    const taken = await until(
      () => heard.pictures.find((p) => p.program && p.program.lanes[0].steps[0] === 410),
      'the new plan',
      40_000,
    );
    // The paper's cycles begin at multiples of 900 steps: the new plan's first one at the next of them.
    assert.equal(Number(taken.programFrom) % 900, 0);
    assert.ok(Number(taken.programFrom) >= asked);
    // The plan PAPER has no yellow: the first is that of the new one, from second 41 to 44 of its cycle.
    const yellow = await until(() => heard.pictures.find((p) => p.heads[0] === 2), 'yellow', 60_000);
    const second = ((Number(yellow.step) - Number(taken.programFrom)) % 900) / 10;
    assert.ok(second >= 41 && second <= 44, `yellow at ${second} s`);
    await panel.getByText('as it runs').waitFor();
  });

  test('a conflicting plan is called so before it is sent, and refused when it is', async () => {
    await panel.locator('[data-lane=NC]').click();
    await panel.getByRole('button', { name: 'none' }).click();
    await panel.locator('[data-lane=NC]').click();
    const line = panel.getByRole('spinbutton', { name: 'Time line' });
    await line.fill('0');
    await line.press('Enter');
    await panel.getByRole('button', { name: 'Set green behind' }).click();
    await panel.getByText('WC and NC cross').waitFor();
    await panel.getByRole('button', { name: 'Apply' }).click();
    await panel.getByRole('alert').getByText('crossing streams').waitFor();
    await panel.getByRole('button', { name: 'Discard' }).click();
    await panel.getByText('as it runs').waitFor();
  });

  test('a cycle out of range is bounded, and undone', async () => {
    const cycle = panel.getByRole('spinbutton', { name: 'Cycle' });
    await cycle.fill('-4');
    await cycle.press('Enter');
    assert.equal(await cycle.inputValue(), '1');
    await panel.getByRole('button', { name: 'Undo' }).click();
    assert.equal(await cycle.inputValue(), '90');
    await panel.getByText('as it runs').waitFor();
  });

  test('a plan goes out as text and comes back', async () => {
    await panel.getByRole('button', { name: 'As text' }).click();
    const text = page.getByRole('textbox', { name: 'Plan as text' });
    const before = await text.inputValue();
    assert.match(before, /cycle_s: 90/);
    await text.fill(before.replace('cycle_s: 90', 'cycle_s: 80'));
    await page.getByRole('button', { name: 'Read' }).click();
    await page.getByText('the cycle is 80 s').waitFor();
    await text.fill(
      before.replaceAll('duration_s: 41', 'duration_s: 40').replaceAll('YELLOW duration_s: 3', 'YELLOW duration_s: 4'),
    );
    await page.getByRole('button', { name: 'Read' }).click();
    assert.equal(await valueOf(0), 40);
    await panel.getByRole('button', { name: 'Discard' }).click();
  });

  test('a head that is clicked opens its lane in the plan', async () => {
    await tab(page, 'Log');
    const head = await page.evaluate(() => {
      const box = document.getElementById('picture').getBoundingClientRect();
      const scale = Math.min(box.width, box.height) / (2 * 65.5 * 1.03);
      // SC: third lane group of the south, 5.25 m east of the centre line, just beyond its stop line.
      return { x: box.x + box.width / 2 + 5.25 * scale, y: box.y + box.height / 2 + (15.5 - 2.7) * scale };
    });
    await page.mouse.click(head.x, head.y);
    await panel.locator('[data-lane=SC][aria-checked=true]').waitFor();
  });
});

describe('looking', { timeout: 150_000 }, () => {
  let run, page, heard, close, errors;
  before(async () => {
    run = await startRun(['--pace', '10']);
    ({ page, heard, close, errors } = await openPage(browser, run.url));
    await until(async () => (await stepOf(page)) > 1200, 'two minutes simulated', 40_000);
  });
  after(async () => {
    await close?.();
    await run?.end();
  });

  test('as many blue and orange pixels as the cars in sight make', async () => {
    await page.locator('#picture').press(' ');
    await until(() => heard.status.phase === 'paused', 'paused');
    await until(async () => (await stepOf(page)) === Number(heard.picture.step), 'the last picture');
    await page.waitForTimeout(400);
    const box = await page.locator('#picture').boundingBox();
    const cars = carsInSight(heard.hello, heard.picture, box, 0.6);
    const { counts } = await coloursAt(page, [], [EQUIPPED, UNEQUIPPED]);
    const scale = Math.min(box.width, box.height) / (2 * 65.5 * 1.03);
    const body = heard.hello.vehicleLengthM * heard.hello.vehicleWidthM * scale * scale;
    // Of a body about six tenths keep its colour: glass, roof mark, lights and rounded corners take the rest.
    const seen = counts.map((pixels) => pixels / (0.6 * body));
    const blue = cars.filter((car) => car.equipped).length;
    const orange = cars.length - blue;
    assert.ok(blue > 3 && orange > 0, `${blue} blue, ${orange} orange`);
    assert.ok(Math.abs(seen[0] - blue) < 0.35 * blue + 3, `blue: ${seen[0]} of ${blue}`);
    assert.ok(Math.abs(seen[1] - orange) < 0.35 * orange + 3, `orange: ${seen[1]} of ${orange}`);
  });

  test('a car that is clicked shows its card and its place in the plane of figure 5; follow keeps it in the middle', async () => {
    const box = await page.locator('#picture').boundingBox();
    const car = carsInSight(heard.hello, heard.picture, box, 2.2).find(
      ({ spot }) => spot.x > 300 && spot.y < box.height - 120 && spot.y > 100,
    );
    await page.mouse.click(box.x + car.spot.x, box.y + car.spot.y);
    const card = page.getByRole('region', { name: `Car ${car.vehicle}` });
    await card.waitFor();
    const i = heard.picture.vehicle.indexOf(car.vehicle);
    await card.getByText(`${(heard.picture.speedMps[i] * 3.6).toFixed(1)} km/h`).waitFor();
    await card.getByRole('button', { name: 'Follow' }).click();
    await page.locator('#picture').press(' ');
    await until(async () => {
      const { colours } = await coloursAt(page, [
        { x: box.width / 2 + 6, y: box.height / 2 },
        { x: box.width / 2, y: box.height / 2 + 6 },
      ]);
      return colours.some((colour) => colour[3] > 200);
    }, 'the car in the middle');
    await page.locator('#picture').press('Escape');
    assert.equal(await card.count(), 0);
    await page.locator('#picture').press('0');
  });

  test('scrub back, and go live', async () => {
    const slider = page.getByRole('slider', { name: 'Look back' });
    await slideTo(page, slider, 0.5);
    const then = await until(
      () => stepOf(page).then((s) => (s < Number(heard.picture.step) - 100 ? s : 0)),
      'an earlier picture',
    );
    await page.getByText(/looking back [\d.]+ s/).waitFor();
    await page.waitForTimeout(500);
    assert.equal(await stepOf(page), then); // it stands while the run goes on
    await page.locator('#picture').press(',');
    await until(async () => (await stepOf(page)) < then, 'one picture back');
    await page.locator('#picture').press('l');
    await until(async () => (await stepOf(page)) >= Number(heard.picture.step) - 10, 'live again');
  });

  test('Chinese and English, light and dark: every panel is clean for axe-core', async () => {
    for (const language of ['en', 'zh']) {
      for (const theme of ['light', 'dark']) {
        for (const key of ['1', '2', '3']) {
          await page.locator('#picture').press(key);
          await page.waitForTimeout(250);
          assert.deepEqual(await axeFindings(page), [], `${language} ${theme} panel ${key}`);
        }
        await page.locator('#picture').press('t');
      }
      await page.getByRole('button', { name: language === 'en' ? '中文' : 'English' }).click();
    }
    await page.getByRole('button', { name: '中文' }).click();
    await page.getByRole('button', { name: '暂停' }).waitFor();
    assert.equal(await page.locator('html').getAttribute('lang'), 'zh-CN');
    await page.reload();
    await page.getByRole('tab', { name: '统计' }).waitFor(); // it is kept
    await page.getByRole('button', { name: 'English' }).click();
    assert.deepEqual(errors, []);
  });

  test('the help lists the keys', async () => {
    await page.locator('#picture').press('?');
    await page.getByRole('dialog', { name: 'Keys' }).waitFor();
    assert.deepEqual(await axeFindings(page), []);
    await page.keyboard.press('Escape');
    await page.getByRole('dialog', { name: 'Keys' }).waitFor({ state: 'hidden' });
  });
});

describe('two viewers', { timeout: 150_000 }, () => {
  test('one acts, the other watches, and control is handed over in sight of both', async (t) => {
    const run = await startRun(['--pace', '1']);
    t.after(() => run.end());
    const one = await openPage(browser, run.url);
    const two = await openPage(browser, run.url);
    await one.page.getByRole('button', { name: 'Take control' }).click();
    await one.page.getByText('You control').waitFor();
    await two.page.getByText(/Viewer \d+ controls/).waitFor();
    assert.ok(await two.page.getByRole('button', { name: 'Pause' }).isDisabled());
    assert.ok(await two.page.getByRole('spinbutton', { name: 'West' }).isDisabled());
    await two.page.getByRole('button', { name: 'Take control' }).click();
    await two.page.getByRole('dialog').getByRole('button', { name: 'Take control' }).click();
    await two.page.getByText('You control').waitFor();
    await one.page.getByText(/Viewer \d+ controls/).waitFor();
    await two.page.getByRole('button', { name: 'Pause' }).click();
    await until(() => one.heard.status.phase === 'paused', 'the first sees the pause');
    await two.page.getByRole('button', { name: 'Release' }).click();
    await one.page.getByText('Nobody controls').waitFor();
    const third = await attach(run.id);
    const three = await openPage(browser, third.url);
    assert.equal(three.heard.hello.run, run.id);
    await three.close();
    await third.end();
    await one.close();
    await two.close();
  });
});

describe('what goes wrong, and the end', { timeout: 150_000 }, () => {
  test('a killed RSU is said, with its process and the time', async (t) => {
    const run = await startRun(['--pace', '10', '--set', 'run.on_rsu_loss=CONTINUE']);
    t.after(() => run.end());
    const { page, heard, close } = await openPage(browser, run.url);
    await until(async () => (await stepOf(page)) > 100, 'the run moves');
    process.kill(memberPid(run, 'lukou-rsu'), 'SIGKILL');
    await tab(page, 'Log');
    await until(() => heard.events.some(({ kind }) => kind === 'lost'), 'the loss');
    await page.getByRole('listitem').filter({ hasText: 'rsu0' }).getByText('lost').first().waitFor();
    await page.getByRole('alert').getByText('Lost: rsu0').waitFor();
    const strip = page.getByRole('group', { name: 'Look back' });
    await strip.getByText('lost rsu0').waitFor(); // the newest event, beside its mark
    assert.equal(await strip.locator('rect.lost').count(), 1);
    const at = await stepOf(page);
    await until(async () => (await stepOf(page)) > at + 50, 'the run goes on without it');
    await close();
  });

  test('a console that is killed is said, and found again when it is back', async (t) => {
    const run = await startRun(['--pace', '10']);
    t.after(() => run.end());
    const first = await attach(run.id);
    const { page, errors, close } = await openPage(browser, first.url);
    await first.end('SIGKILL');
    await page.getByText('connection lost').waitFor();
    assert.ok(await page.getByRole('button', { name: 'Pause' }).isDisabled());
    const second = await attach(run.id, new URL(first.url).port);
    t.after(() => second.end());
    await page.getByRole('status').getByText('running').waitFor();
    const step = await stepOf(page);
    await until(async () => (await stepOf(page)) > step, 'the picture moves again');
    // The browser itself reports each attempt that found nobody.
    assert.deepEqual(
      errors.filter((text) => !text.includes('ERR_CONNECTION_REFUSED')),
      [],
    );
    await close();
  });

  test('End asks first, and the page says that the run has ended', async (t) => {
    const run = await startRun(['--pace', '1']);
    t.after(() => run.end());
    const { page, close } = await openPage(browser, run.url);
    await page.getByRole('button', { name: 'End', exact: true }).click();
    await page.getByRole('dialog').getByRole('button', { name: 'Cancel' }).click();
    await page.getByRole('button', { name: 'End', exact: true }).click();
    await page.getByRole('dialog').getByRole('button', { name: 'End' }).click();
    // The console goes on showing the end for as long as somebody looks.
    await page.getByRole('status').getByText('ended', { exact: true }).waitFor();
    assert.ok(await page.getByRole('button', { name: 'Step' }).isDisabled());
    await close();
    assert.equal(await run.process.ended, 0);
  });
});

describe('the results', { timeout: 150_000 }, () => {
  test('a session of clicks, replayed from its directives, gives the same bytes again', async (t) => {
    const length = ['--duration', '200'];
    const run = await startRun(['--pace', '2', ...length]);
    t.after(() => run.end());
    const { page, heard, close } = await openPage(browser, run.url);
    const ratio = page.getByRole('spinbutton', { name: 'Equipped ratio' });
    await ratio.fill('0.4');
    await ratio.press('Enter');
    await page.locator('#picture').press(' ');
    await until(() => heard.status.phase === 'paused', 'paused');
    await slideTo(page, page.getByRole('slider', { name: 'West' }), 0.8);
    await page.locator('#picture').press('.');
    await tab(page, 'Signals');
    await page.getByRole('tabpanel').getByRole('combobox').selectOption('PROTECTED_LEFT');
    await page.getByRole('button', { name: 'Apply' }).click();
    await until(() => directives(heard).length === 3, 'three directives');
    await speed(page, 'Max');
    await page.locator('#picture').press(' ');
    await until(() => heard.status.phase === 'ended', 'the end', 60_000);
    await close();
    assert.equal(await run.process.ended, 0);
    const again = join(run.out, '..', 'again');
    await runToEnd([
      '--quiet',
      '--out',
      again,
      '--replay-directives',
      join(run.out, 'directives.textproto'),
      ...length,
    ]);
    // Facts of the wall clock stand in these two and nowhere else.
    const compared = readdirSync(run.out).filter((name) => !['timing.json', 'operator.log'].includes(name));
    assert.ok(compared.includes('car.csv') && compared.includes('directives.textproto'), compared.join());
    for (const name of compared) {
      assert.ok(readFileSync(join(run.out, name)).equals(readFileSync(join(again, name))), `${name} differs`);
    }
  });
});
