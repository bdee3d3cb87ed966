// Ways of looking and acting beside the usual ones: over the map, by link, in Chinese, on a tablet, at the radio.
import assert from 'node:assert/strict';
import { after, before, describe, test } from 'node:test';

import { ADVICE, coloursAt, GREEN, LOST, near, RED, uplinkMarks } from './pixels.mjs';
import { axeFindings, directives, launch, openPage, slideTo, startRun, stepOf, until } from './session.mjs';

let browser;
before(async () => (browser = await launch()));
after(async () => browser?.close());

const west = 'traffic.west.flow_veh_per_h';
const texts = (heard) => directives(heard).map(({ text }) => text);

describe('values', { timeout: 120_000 }, () => {
  let run, page, heard, close, errors;
  before(async () => {
    run = await startRun(['--pace', '10']);
    ({ page, heard, close, errors } = await openPage(browser, run.url));
  });
  after(async () => {
    await close?.();
    await run?.end();
  });

  test('the sign over an approach carries the control of its flow', async () => {
    const sign = page.getByRole('button', { name: 'West: 1800 veh/h' });
    await sign.click();
    const box = page.getByRole('group', { name: 'Flow from the West' });
    await slideTo(page, box.getByRole('slider', { name: 'West' }), 0.25);
    await until(() => texts(heard).includes(`${west}=900`), 'the directive');
    await page.getByRole('button', { name: 'West: 900 veh/h' }).waitFor();
    assert.deepEqual(await axeFindings(page), []);
    await page.keyboard.press('Escape');
    await box.waitFor({ state: 'hidden' });
    // By keyboard: the sign has the focus again.
    await page.keyboard.press('Enter');
    await page.keyboard.press('ArrowRight');
    await until(() => texts(heard).includes(`${west}=950`), 'the directive of a key');
    await page.keyboard.press('Escape');
  });

  test('the signs follow the picture, and go with what is out of sight', async () => {
    const sign = page.getByRole('button', { name: /^North: / });
    const from = await sign.boundingBox();
    await page.locator('#picture').press('ArrowRight');
    await until(async () => Math.abs((await sign.boundingBox()).x - from.x + 40) < 2, 'the sign has moved along');
    for (let i = 0; i < 4; ++i) await page.locator('#picture').press('Shift+ArrowRight');
    await sign.waitFor({ state: 'hidden' });
    await page.locator('#picture').press('Home');
    await sign.waitFor();
  });

  test('changes are taken back one by one, as further changes', async () => {
    await page.locator('#picture').press('u');
    await until(() => texts(heard).at(-1) === `${west}=900`, 'the value before');
    const undo = page.getByRole('region', { name: 'Traffic' }).getByRole('button', { name: 'Undo' });
    await undo.click();
    await until(() => texts(heard).at(-1) === `${west}=1800`, 'the first value');
    await until(() => undo.isDisabled(), 'nothing is left');
  });

  test('all four keep their proportions if asked, and are taken back together', async () => {
    await page.getByRole('spinbutton', { name: 'West' }).fill('900');
    await page.getByRole('spinbutton', { name: 'West' }).press('Enter');
    await until(() => texts(heard).at(-1) === `${west}=900`, 'the directive');
    await page.getByRole('checkbox', { name: 'keep their proportions' }).check();
    const count = texts(heard).length;
    await page.getByRole('slider', { name: 'All four' }).press('Home');
    await until(() => texts(heard).length === count + 4, 'four directives');
    await page.locator('#picture').press('u');
    await until(() => texts(heard).length === count + 8, 'four more');
    assert.ok(texts(heard).slice(-4).includes(`${west}=900`), texts(heard).slice(-4).join());
  });

  test('a value goes back to what the run began with', async () => {
    await page.getByRole('button', { name: 'West: back to 1800' }).click();
    await until(() => texts(heard).at(-1) === `${west}=1800`, 'the directive');
    await page.getByRole('button', { name: 'West: back to 1800' }).waitFor({ state: 'hidden' });
  });

  test('an applied plan is taken back to the preset', async () => {
    await page.locator('#picture').press('2');
    await page.getByRole('tabpanel').getByRole('combobox').selectOption('PROTECTED_LEFT');
    await page.getByRole('button', { name: 'Apply' }).click();
    await until(() => texts(heard).at(-1).startsWith('signals.plan='), 'the plan');
    await page.locator('#picture').press('u');
    await until(() => texts(heard).at(-1) === 'signals.preset=PAPER', 'the preset');
  });

  test('the figures have a trend of both groups', async () => {
    await page.locator('#picture').press('1');
    await until(async () => (await stepOf(page)) > 1500, '150 s simulated', 40_000);
    const row = page.locator('[data-figure=inSystem]');
    for (const group of ['equipped', 'unequipped']) {
      await until(
        async () => (await row.locator(`path.${group}`).getAttribute('d'))?.length > 60,
        `a line of ${group}`,
      );
    }
    await page
      .getByText(/Guided now: \d+ \(.*advice \d+/)
      .or(page.getByText('Guided now: nobody'))
      .waitFor();
    await page.locator('[data-figure=meanDelay] button').hover();
    await page.getByText(/Equipped less unequipped: [+−]?\d/).waitFor();
    assert.deepEqual(errors, []);
  });

  test('overrides stand in the event strip, and counted by rule in the log', async () => {
    // Limit, guard, following, light, driver: that of following is no event.
    const counted = () => (heard.statistics?.overridden ?? []).reduce((sum, n, i) => sum + (i === 2 ? 0 : n), 0);
    await until(() => counted() > 2, 'three overrides', 60_000);
    await page.locator('#picture').press(' ');
    await until(() => heard.status.phase === 'paused', 'paused');
    await page.waitForTimeout(700);
    assert.match(await page.locator('path.overrides').getAttribute('d'), /^M.*z$/);
    await page.locator('#picture').press('3');
    const entries = page.getByRole('listitem').filter({ hasText: 'override' });
    const listed = (await entries.allInnerTexts()).join('\n').matchAll(/(?:limit|guard|light|driver) (\d+)/g);
    assert.equal(
      [...listed].reduce((sum, [, n]) => sum + Number(n), 0),
      counted(),
    );
    await page.locator('#picture').press(' ');
    // A step of the log is looked at.
    const step = Number((await entries.first().getByRole('button').innerText()).match(/\d+/)[0]);
    await entries.first().getByRole('button').click();
    await until(async () => Math.abs((await stepOf(page)) - step) < 30, 'that step');
    await page.locator('#picture').press('l');
  });

  test('what the server refuses is said in Chinese', async () => {
    await page.getByRole('button', { name: '中文' }).click();
    const flow = page.getByRole('spinbutton', { name: '西' });
    await flow.fill('99999');
    await flow.press('Enter');
    await page
      .getByText('traffic.west.flow_veh_per_h 为 99999 veh/h，须在 [0, 10800] veh/h 之内', { exact: true })
      .waitFor();
    await page.locator('#picture').press('3');
    await page.getByRole('listitem').filter({ hasText: '拒绝' }).getByText('须在 [0, 10800]').waitFor();
    await page
      .getByRole('button', { name: '取得控制' })
      .or(page.getByRole('button', { name: '放弃' }))
      .first()
      .waitFor();
    await page.getByRole('listitem').filter({ hasText: '1 号观察者取得控制' }).waitFor();
    assert.deepEqual(await axeFindings(page), []);
  });
});

describe('charts', { timeout: 120_000 }, () => {
  test('have a crosshair and a zoom by keyboard, and keep a ghost over a restart', async (t) => {
    const run = await startRun(['--pace', '100']);
    t.after(() => run.end());
    const { page, heard, close, errors } = await openPage(browser, run.url);
    await until(async () => (await stepOf(page)) > 3000, 'five minutes simulated', 40_000);
    const chart = page.getByRole('group', { name: 'Throughput' });
    await chart.focus();
    for (let i = 0; i < 10; ++i) await page.keyboard.press('ArrowLeft');
    const time = async () => Number(await chart.locator('.u-legend .u-value').first().innerText());
    assert.ok(
      (await time()) > 100 && (await time()) < Number(heard.statistics.step) / 10,
      'the crosshair stands earlier',
    );
    // At 100x the charts move on, all at once.
    const times = () =>
      page.evaluate(() =>
        ['throughput', 'delay'].map((name) =>
          Number(document.querySelector(`#chart-${name} .u-legend .u-value`).textContent),
        ),
      );
    for (let i = 0; i < 10; ++i) {
      const [here, there] = await times();
      assert.ok(here > 100 && there === here, `in this chart at ${here}, in another at ${there}`);
      await page.waitForTimeout(137);
    }
    await page.keyboard.press('+');
    await page.keyboard.press('+');
    await page.keyboard.press('Home');
    // A line in grey, that stays when another seed begins.
    const greys = () =>
      chart.locator('canvas').evaluate((canvas) => {
        const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
        let n = 0;
        for (let i = 0; i < data.length; i += 4) {
          const off = Math.abs(data[i] - 0x8b) + Math.abs(data[i + 1] - 0x97) + Math.abs(data[i + 2] - 0xa3);
          if (data[i + 3] > 200 && off < 12) ++n;
        }
        return n;
      });
    const before = await greys();
    await page.getByRole('button', { name: 'Keep as ghost' }).click();
    await until(async () => (await greys()) > before + 100, 'the ghost');
    await page.getByRole('button', { name: 'Restart' }).click();
    await page.getByRole('dialog').getByRole('spinbutton', { name: 'Seed' }).fill('9');
    await page.getByRole('dialog').getByRole('button', { name: 'Restart' }).click();
    await until(() => heard.hello.seed === '9', 'the other run', 30_000);
    await until(
      async () => (await stepOf(page)) > 1500 && (await greys()) > before + 50,
      'the ghost beside it',
      40_000,
    );
    await page.getByRole('button', { name: 'Drop the ghost' }).click();
    await until(async () => (await greys()) < before + 50, 'it is gone');
    assert.deepEqual(errors, []);
    await close();
  });
});

describe('links', { timeout: 120_000 }, () => {
  test('a copied link shows the same again: camera, colours, car, panel, language', async (t) => {
    const run = await startRun(['--pace', '1', '--set', 'radio.preset=HARSH']);
    t.after(() => run.end());
    const first = await openPage(browser, run.url, { permissions: ['clipboard-read', 'clipboard-write'] });
    const { page } = first;
    run.ctl('pace', '100');
    await until(async () => (await stepOf(page)) > 900, '90 s simulated');
    run.ctl('pause');
    await until(() => first.heard.status.phase === 'paused', 'paused');
    const car = first.heard.picture.vehicle.at(-1);
    await page.getByRole('button', { name: '中文' }).click();
    await page.locator('#picture').press('2');
    await page.locator('#picture').press('c');
    await page.locator('#picture').press('r');
    await page.getByRole('spinbutton', { name: '按编号查找车辆' }).fill(String(car));
    await page.keyboard.press('Enter');
    await page.getByRole('button', { name: '复制可恢复此视图的链接' }).click();
    const link = await page.evaluate(() => navigator.clipboard.readText());
    assert.match(
      link,
      new RegExp(`#panel=signals&colour=speed&radio&reach=[\\d.]+&car=${car}&follow&lang=zh&theme=light$`),
    );
    assert.equal(page.url(), link); // the address shows it, too
    const second = await openPage(browser, link);
    await second.page.getByRole('region', { name: `车辆 ${car}` }).waitFor();
    assert.equal(await second.page.getByRole('button', { name: '跟随' }).getAttribute('aria-pressed'), 'true');
    assert.equal(await second.page.getByRole('tab', { name: '信号' }).getAttribute('aria-selected'), 'true');
    assert.equal(await second.page.getByRole('combobox', { name: '着色' }).inputValue(), 'speed');
    // A picture that was moved and zoomed by hand stands where it stood.
    await second.page.locator('#picture').press('Escape');
    await second.page.locator('#picture').press('0');
    for (const key of ['ArrowLeft', 'ArrowUp', '+', '+']) await second.page.locator('#picture').press(key);
    await until(() => /reach=38\.8&centre=-?[\d.]+,-?[\d.]+/.test(second.page.url()), 'the address follows');
    const third = await openPage(browser, second.page.url());
    const stopLines = (p) => coloursAt(p, [], [RED, GREEN]).then(({ counts }) => counts);
    const [a, b] = [await stopLines(second.page), await stopLines(third.page)];
    assert.ok(a[0] > 100 && a[1] > 100, a.join());
    a.forEach((pixels, i) => assert.ok(Math.abs(pixels - b[i]) < 0.1 * pixels, `${a} and ${b}`));
    await Promise.all([first.close(), second.close(), third.close()]);
  });

  test('the token of the address is not in the copied link', async (t) => {
    const run = await startRun(['--pace', '1']);
    t.after(() => run.end());
    const { page, close } = await openPage(browser, `${run.url}?token=0123456789abcdef0123`, {
      permissions: ['clipboard-read', 'clipboard-write'],
    });
    await page.getByRole('button', { name: 'Copy a link' }).click();
    const link = await page.evaluate(() => navigator.clipboard.readText());
    assert.ok(!link.includes('token'), link);
    await close();
  });
});

describe('the radio', { timeout: 120_000 }, () => {
  test('a car that was heard has a full wedge, one that was lost a struck one, and the card says why', async (t) => {
    const run = await startRun(['--pace', '100', '--set', 'radio.uplink.loss.rate=0.4']);
    t.after(() => run.end());
    const { page, heard, close } = await openPage(browser, run.url);
    await until(async () => (await stepOf(page)) > 2400, 'four minutes simulated', 40_000);
    await page.locator('#picture').press(' ');
    await until(() => heard.status.phase === 'paused', 'paused');
    await until(async () => (await stepOf(page)) === Number(heard.status.granted), 'the last picture');
    await page.locator('#picture').press('r');
    const box = await page.locator('#picture').boundingBox();
    const marksNow = () => uplinkMarks(heard.hello, heard.picture, box);
    const fewest = () => {
      const fates = marksNow().map(({ fate }) => fate);
      return Math.min(fates.filter((f) => f === 0).length, fates.filter((f) => f > 0 && f < 255).length);
    };
    for (let i = 0; i < 80 && fewest() < 3; ++i) {
      const step = await stepOf(page);
      await page.locator('#picture').press('.');
      await until(async () => (await stepOf(page)) > step, 'one step more');
    }
    await page.waitForTimeout(300);
    const marks = marksNow();
    const around = [-3, -2, -1, 0, 1, 2, 3].flatMap((dx) => [-3, -2, -1, 0, 1, 2, 3].map((dy) => [dx, dy]));
    const { colours } = await coloursAt(
      page,
      marks.flatMap(({ spot }) => around.map(([dx, dy]) => ({ x: spot.x + dx, y: spot.y + dy }))),
    );
    const seen = marks.map((mark, i) => {
      const patch = colours.slice(i * around.length, (i + 1) * around.length);
      return {
        ...mark,
        full: near(patch[24], ADVICE), // in its middle
        struck: patch.filter((colour) => near(colour, LOST)).length > 2,
      };
    });
    const heardOnes = seen.filter(({ fate }) => fate === 0);
    const lost = seen.filter(({ fate }) => fate > 0 && fate < 255);
    const silent = seen.filter(({ fate }) => fate === 255);
    assert.ok(heardOnes.length > 2 && lost.length > 2, `${heardOnes.length} heard, ${lost.length} lost`);
    for (const { vehicle, full } of heardOnes) assert.ok(full, `car ${vehicle} was heard`);
    for (const { vehicle, struck } of lost) assert.ok(struck, `car ${vehicle} was lost`);
    for (const { vehicle, full } of silent) assert.ok(!full, `car ${vehicle} sends nothing`);
    // The card of one that was lost.
    await page.getByRole('spinbutton', { name: 'Find a car' }).fill(String(lost[0].vehicle));
    await page.keyboard.press('Enter');
    const card = page.getByRole('region', { name: `Car ${lost[0].vehicle}` });
    await card.getByText(/lost: random; heard [\d.]+ s ago/).waitFor();
    await page.getByRole('button', { name: 'Last minute' }).click();
    await page.getByText(/to RSU: random, 0.0 s ago/).waitFor();
    assert.deepEqual(await axeFindings(page), []);
    // By the age of the last message heard: those of now are brightest.
    await page.getByRole('combobox', { name: 'Colour' }).selectOption('heard');
    await page.getByText('never heard by an RSU').waitFor();
    await close();
  });
});

describe('a tablet', { timeout: 120_000 }, () => {
  test('has everything within its width, upright and lying, and works by touch', async (t) => {
    const run = await startRun(['--pace', '10']);
    t.after(() => run.end());
    for (const viewport of [
      { width: 1024, height: 768 },
      { width: 768, height: 1024 },
    ]) {
      const { page, heard, close } = await openPage(browser, run.url, { viewport, hasTouch: true, isMobile: true });
      await until(async () => (await stepOf(page)) > 300, 'half a minute simulated');
      const wide = await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
      assert.ok(wide <= 0, `${wide} px too wide at ${viewport.width}`);
      await page.getByRole('tab', { name: 'Signals' }).tap();
      await page.getByRole('button', { name: /^South: / }).tap();
      await page.getByRole('group', { name: 'Flow from the South' }).waitFor();
      await page.getByRole('button', { name: 'Close', exact: true }).tap();
      await page.getByRole('button', { name: 'Pause' }).tap();
      await until(() => heard.status.phase === 'paused', 'paused');
      await page.getByRole('button', { name: 'Resume' }).tap();
      assert.deepEqual(await axeFindings(page), []);
      await page.getByRole('button', { name: 'Release' }).tap();
      await close();
    }
  });
});
