// Every control of the page: what each does to the run, by which keys, with which name, in both languages.
import assert from 'node:assert/strict';
import { after, before, describe, test } from 'node:test';

import { axeFindings, directives, launch, memberPid, openPage, slideTo, startRun, stepOf, until } from './session.mjs';

let browser;
before(async () => (browser = await launch()));
after(async () => browser?.close());

const SIDES = ['West', 'South', 'East', 'North'];
const texts = (heard) => directives(heard).map(({ text }) => text);
const speed = (page, name) =>
  page.getByRole('group', { name: 'Speed' }).getByRole('button', { name, exact: true }).click();

/** Cars that arrive on each approach while some time is simulated. */
async function arrivalsIn(heard, seconds) {
  const from = [...heard.statistics.arrived];
  const at = Number(heard.statistics.step);
  await until(() => Number(heard.statistics.step) >= at + 10 * seconds, `${seconds} s simulated`, 40_000);
  return heard.statistics.arrived.map((n, i) => n - from[i]);
}

describe('a run that waits', { timeout: 90_000 }, () => {
  test('takes flows, ratio and plan before its first step, and begins with them', async (t) => {
    const run = await startRun(['--pace', '10', '--wait']);
    t.after(() => run.end());
    const { page, heard, close } = await openPage(browser, run.url);
    for (const side of SIDES.slice(1)) await page.getByRole('slider', { name: side }).press('Home');
    const ratio = page.getByRole('spinbutton', { name: 'Equipped ratio' });
    await ratio.fill('1');
    await ratio.press('Enter');
    await page.getByRole('tab', { name: 'Signals' }).click();
    await page.getByRole('tabpanel').getByRole('combobox').selectOption('PAPER_YELLOW');
    await page.getByRole('button', { name: 'Apply' }).click();
    await until(() => texts(heard).length === 5, 'five directives');
    assert.equal(await stepOf(page), 0);
    await page.getByRole('button', { name: '▶ Start' }).click();
    await until(() => Number(heard.statistics.step) > 1200, 'two minutes simulated', 40_000);
    const [west, ...others] = heard.statistics.arrived;
    assert.ok(west > 30, `west ${west}`); // 1800 veh/h for 120 s: 60 on average
    // What is asked at step 0 holds from the step after the next grant on.
    assert.ok(
      others.every((n) => n <= 2),
      others.join(),
    );
    assert.ok(heard.statistics.unequipped.arrived <= 3, 'nobody without a unit but of the first steps');
    await until(() => heard.pictures.some(({ heads }) => heads.includes(2)), 'yellow', 40_000); // the plan PAPER has none
    await close();
  });
});

describe('what each control does', { timeout: 200_000 }, () => {
  let run, page, heard, close;
  before(async () => {
    run = await startRun(['--pace', '25', '--set', 'run.on_overflow=CONTINUE']);
    ({ page, heard, close } = await openPage(browser, run.url));
    await until(() => heard.statistics !== undefined, 'figures');
  });
  after(async () => {
    await close?.();
    await run?.end();
  });

  test('the slider of each approach changes the arrivals of that approach, and of no other', async () => {
    for (const side of SIDES) await page.getByRole('slider', { name: side }).press('Home');
    await until(() => texts(heard).length === 4, 'four directives');
    await until(() => Number(heard.statistics.step) > Number(directives(heard).at(-1).step) + 20, 'they are in force');
    for (const [i, side] of SIDES.entries()) {
      await slideTo(page, page.getByRole('slider', { name: side }), 0.75); // 2700 veh/h
      await until(() => texts(heard).at(-1).startsWith(`traffic.${side.toLowerCase()}.`), 'the directive');
      await until(() => Number(heard.statistics.step) > Number(directives(heard).at(-1).step), 'it is in force');
      const grown = await arrivalsIn(heard, 60); // 45 on average
      assert.ok(grown[i] > 20, `${side}: ${grown}`);
      assert.ok(
        grown.every((n, j) => j === i || n === 0),
        `${side}: ${grown}`,
      );
      await page.getByRole('slider', { name: side }).press('Home');
      await until(() => texts(heard).at(-1).endsWith('=0'), 'back to none');
      await until(() => Number(heard.statistics.step) > Number(directives(heard).at(-1).step) + 20, 'it is in force');
    }
    await page.getByRole('slider', { name: 'All four' }).press('End');
    await until(
      () =>
        texts(heard)
          .slice(-4)
          .every((text) => text.endsWith('=3600')),
      'four directives',
    );
    const grown = await arrivalsIn(heard, 60);
    assert.ok(
      grown.every((n) => n > 30),
      grown.join(),
    );
  });

  test('loss and latency of the radio act on the messages of that direction', async () => {
    await page.locator('summary').getByText('Radio', { exact: true }).click();
    await page.getByRole('slider', { name: 'Latency, car to RSU' }).press('End');
    await until(() => heard.statistics.latencyUpMs > 500, 'messages to the RSU take longer');
    await page.getByRole('slider', { name: 'Latency, car to RSU' }).press('Home'); // an RSU that hears old news alone says nothing
    await until(() => heard.statistics.latencyUpMs < 100, 'and again they do not');
    await page.getByRole('slider', { name: 'Loss, RSU to car' }).press('End');
    await until(() => texts(heard).includes('radio.downlink.loss.rate=1'), 'the directive');
    await until(() => heard.statistics.deliveryRatioDown === 0, 'no word reaches a car any more');
    assert.ok(heard.statistics.deliveryRatioUp > 0.9, `to the RSU ${heard.statistics.deliveryRatioUp}`);
    await page
      .getByText(/RSU to car random \d+/)
      .first()
      .waitFor();
    await page.locator('#picture').press('u');
    await until(() => heard.statistics.deliveryRatioDown > 0.9, 'and again they do');
  });

  test('the twelve figures are those that the server says', async () => {
    await page.locator('#picture').press(' ');
    await until(() => heard.status.phase === 'paused', 'paused');
    await page.waitForTimeout(700);
    const shown = async (figure) =>
      (await page.locator(`[data-figure=${figure}] td`).allInnerTexts()).slice(0, 3).map((text) => text.trim());
    const { all, equipped, unequipped } = heard.statistics;
    const groups = (of) => [all, equipped, unequipped].map(of);
    assert.equal(await page.locator('[data-figure]').count(), 12);
    for (const [figure, of] of [
      ['arrived', (f) => f.arrived],
      ['waiting', (f) => f.waitingOutside],
      ['inSystem', (f) => f.inSystem],
      ['left', (f) => f.left],
      ['standing', (f) => f.standing],
      ['stops', (f) => f.stops],
    ]) {
      assert.deepEqual(await shown(figure), groups(of).map(String), figure);
    }
    for (const [figure, of, slack] of [
      ['throughput', (f) => f.throughputVehPerH, 0.51],
      ['stopsPerCar', (f) => f.stopsPerVehicle, 0.0051],
      ['stopTime', (f) => f.stopTimeS, 0.51],
      ['meanStopTime', (f) => f.meanStopTimeS, 0.051],
      ['meanDelay', (f) => f.meanDelayS, 0.051],
    ]) {
      const read = await shown(figure);
      groups(of).forEach((value, i) =>
        assert.ok(Math.abs(Number(read[i]) - value) <= slack, `${figure}: ${read[i]} for ${value}`),
      );
    }
    assert.match((await shown('time'))[0], /\d/);
    await page.locator('#picture').press(' ');
  });

  test('at 0.1x and at 1x every step is drawn', async () => {
    for (const [name, steps] of [
      ['Slow', 20],
      ['Very slow', 4],
    ]) {
      await speed(page, name);
      await until(() => heard.status.paceAchieved < (name === 'Slow' ? 1.3 : 0.2), `${name} achieved`);
      // A busy machine may hold the run up, and its pictures catch up in one: so many in a row are enough.
      const inARow = await page.evaluate(
        (wanted) =>
          new Promise((resolve) => {
            const picture = document.getElementById('picture');
            let row = [];
            const begin = performance.now();
            const observer = new MutationObserver(() => {
              const step = Number(picture.dataset.step);
              if (step === row.at(-1)) return;
              row = step === row.at(-1) + 1 ? [...row, step] : [step];
              if (row.length < wanted && performance.now() - begin < 40_000) return;
              observer.disconnect();
              resolve(row.length);
            });
            observer.observe(picture, { attributeFilter: ['data-step'] });
          }),
        steps,
      );
      assert.equal(inARow, steps, name);
    }
  });
});

/** Views that open over the others or in them: how each is opened, and closed again. */
const VIEWS = [
  ['the help', (page) => page.locator('#picture').press('?'), (page) => page.keyboard.press('Escape')],
  [
    'the question before the end',
    (page, zh) => page.getByRole('button', { name: zh ? '结束' : 'End', exact: true }).click(),
    (page) => page.keyboard.press('Escape'),
  ],
  [
    'the question before a restart',
    (page, zh) => page.getByRole('button', { name: zh ? '重新开始' : 'Restart' }).click(),
    (page) => page.keyboard.press('Escape'),
  ],
  [
    'the plan as text',
    async (page, zh) => {
      await page.locator('#picture').press('2');
      await page.getByRole('button', { name: zh ? '文本' : 'As text' }).click();
    },
    (page) => page.keyboard.press('Escape'),
  ],
  [
    "the run's scenario in the log",
    async (page) => {
      await page.locator('#picture').press('3');
      await page.getByRole('tabpanel').locator('summary').click();
    },
    (page) => page.getByRole('tabpanel').locator('summary').click(),
  ],
  [
    'radio and all that may change',
    async (page) => {
      for (const summary of await page.locator('section.panel summary').all()) await summary.click();
    },
    async (page) => {
      for (const summary of await page.locator('section.panel summary').all()) await summary.click();
    },
  ],
  [
    'the control of a flow on the map',
    (page, zh) => page.getByRole('button', { name: zh ? /^西：|^西:/ : /^West: \d/ }).click(),
    (page) => page.keyboard.press('Escape'),
  ],
  [
    'the card of a car',
    (page) => page.locator('#picture').press('n'),
    (page) => page.locator('#picture').press('Escape'),
  ],
  [
    'its last minute',
    async (page, zh) => {
      await page.locator('#picture').press('n');
      await page.getByRole('button', { name: zh ? '最近一分钟' : 'Last minute' }).click();
    },
    (page) => page.locator('#picture').press('Escape'),
  ],
  ['the radio layer', (page) => page.locator('#picture').press('r'), (page) => page.locator('#picture').press('r')],
  ['a look back', (page) => page.locator('#picture').press(','), (page) => page.locator('#picture').press('l')],
];

describe('every view', { timeout: 240_000 }, () => {
  let run, page, errors, close;
  before(async () => {
    run = await startRun(['--pace', '100', '--set', 'radio.preset=HARSH']);
    ({ page, errors, close } = await openPage(browser, run.url));
    await until(async () => (await stepOf(page)) > 900, '90 s simulated');
    run.ctl('pace', '1');
  });
  after(async () => {
    await close?.();
    await run?.end();
  });

  for (const zh of [false, true]) {
    test(`is clean for axe-core, ${zh ? 'Chinese' : 'English'}`, async () => {
      if (zh) await page.getByRole('button', { name: '中文' }).click();
      for (const [what, open, shut] of VIEWS) {
        await open(page, zh);
        await page.waitForTimeout(150);
        assert.deepEqual(await axeFindings(page), [], what);
        await shut(page, zh);
      }
      const colours = page.getByRole('combobox', { name: zh ? '着色' : 'Colour' });
      for (const colouring of await colours.locator('option').evaluateAll((all) => all.map((o) => o.value))) {
        await colours.selectOption(colouring);
        assert.deepEqual(await axeFindings(page), [], `colour ${colouring}`);
      }
      if (zh) await page.getByRole('button', { name: 'English' }).click();
      assert.deepEqual(errors, []);
    });
  }

  test('has no control that Tab does not reach, and none without a name', async () => {
    await page.locator('#picture').press('n'); // with a card, of a car that stays
    run.ctl('pause');
    for (const key of ['1', '2', '3']) {
      await page.locator('#picture').press(key);
      await page.getByRole('tabpanel').first().waitFor();
      const controls = await page.evaluate(() => {
        const seen = (e) => e.checkVisibility({ visibilityProperty: true }) && !e.closest('dialog:not([open])');
        const all = [
          ...document.querySelectorAll('button, input, select, textarea, summary, [role=slider], [role=checkbox]'),
        ];
        const usable = all.filter((e) => seen(e) && !e.disabled && e.getAttribute('role') !== 'tab');
        usable.forEach((e, i) => e.setAttribute('data-nth', String(i)));
        document.getElementById('picture').focus();
        return usable.map((e) => `${e.tagName} ${e.getAttribute('aria-label') ?? e.innerText ?? ''} ${e.title}`.trim());
      });
      const reached = new Set();
      for (let i = 0; i < 2 * controls.length + 20 && reached.size < controls.length; ++i) {
        await page.keyboard.press('Tab');
        const nth = await page.evaluate(() => document.activeElement?.getAttribute('data-nth') ?? '');
        if (nth !== '') reached.add(Number(nth));
      }
      const missed = controls.filter((_, i) => !reached.has(i));
      assert.ok(controls.length > 30, `${controls.length} controls`);
      assert.deepEqual(missed, [], `panel ${key}`);
      await page.evaluate(() => document.querySelectorAll('[data-nth]').forEach((e) => e.removeAttribute('data-nth')));
    }
    for (const role of ['button', 'slider', 'spinbutton', 'combobox', 'checkbox', 'textbox', 'tab']) {
      assert.equal(await page.getByRole(role, { name: /^\s*$/ }).count(), 0, `${role} without a name`);
    }
  });
});

const otherLanguage = (page) => page.getByRole('button', { name: /^(中文|English)$/ }).click();

/** English and light, Chinese and dark; ends as it began. */
async function cleanInBoth(page, what) {
  for (const look of ['English', 'Chinese']) {
    assert.deepEqual(await axeFindings(page), [], `${what}, ${look}`);
    await page.locator('#picture').press('t');
    await otherLanguage(page);
    await page.waitForTimeout(150);
  }
}

describe('every state of a run is clean for axe-core in both languages:', { timeout: 240_000 }, () => {
  let run, page, heard, errors, close;
  before(async () => {
    run = await startRun(['--pace', '10', '--set', 'run.on_rsu_loss=CONTINUE']);
    ({ page, heard, errors, close } = await openPage(browser, run.url, { colorScheme: 'light' }));
    await until(async () => (await stepOf(page)) > 300, '30 s simulated');
  });
  after(async () => {
    await close?.();
    await run?.end();
  });

  test('a plan that was refused', async () => {
    await page.getByRole('tab', { name: 'Signals' }).click();
    const panel = page.getByRole('tabpanel');
    await panel.locator('[data-lane=NC]').click();
    await panel.getByRole('button', { name: 'Set green behind' }).click();
    await panel.getByRole('button', { name: 'Apply' }).click();
    await panel.getByRole('alert').getByText('crossing streams').waitFor();
    await cleanInBoth(page, 'a refused plan');
    await panel.getByRole('button', { name: 'Discard' }).click();
  });

  test('the question before control is taken from another', async () => {
    const two = await openPage(browser, run.url, { colorScheme: 'light' });
    for (const [take, taken] of [
      ['Take control', 'You control'],
      ['取得控制', '由您控制'],
    ]) {
      await two.page.getByRole('button', { name: take }).click();
      await two.page.getByRole('dialog').waitFor();
      assert.deepEqual(await axeFindings(two.page), [], take);
      await two.page.keyboard.press('Escape');
      await otherLanguage(two.page);
      assert.equal(await two.page.getByText(taken).count(), 0);
    }
    await cleanInBoth(two.page, 'one that only watches');
    await two.close();
  });

  test('an RSU that was lost', async () => {
    process.kill(memberPid(run, 'lukou-rsu'), 'SIGKILL');
    // Whatever panel is open.
    await page.getByRole('alert').getByText('Lost: rsu0').waitFor();
    for (const key of ['1', '3']) {
      await page.locator('#picture').press(key);
      await cleanInBoth(page, `a lost RSU, panel ${key}`);
    }
  });

  test('a run that has ended', async () => {
    await page.getByRole('button', { name: 'End', exact: true }).click();
    await page.getByRole('dialog').getByRole('button', { name: 'End' }).click();
    await until(() => heard.status.phase === 'ended', 'the end');
    for (const key of ['1', '2', '3']) {
      await page.locator('#picture').press(key);
      await cleanInBoth(page, `an ended run, panel ${key}`);
    }
    assert.deepEqual(errors, []);
  });

  test('a run that was aborted because its engine is gone', async (t) => {
    const other = await startRun(['--pace', '10']);
    t.after(() => other.end());
    const viewer = await openPage(browser, other.url, { colorScheme: 'light' });
    await until(async () => (await stepOf(viewer.page)) > 50, 'the run moves');
    process.kill(memberPid(other, 'lukou-traffic-engine'), 'SIGKILL');
    await until(() => viewer.heard.status.phase === 'aborted', 'aborted', 30_000);
    await viewer.page.getByRole('alert').getByText('traffic-engine').waitFor();
    await viewer.page.locator('#picture').press('3');
    await cleanInBoth(viewer.page, 'an aborted run');
    await viewer.close();
  });
});
