// The page of `lukou report`, opened as a reader does: from a file, without a network.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { axeSource, chromium, programs, runToEnd } from './session.mjs';

let folder;
let browser;

before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'lukou-report-'));
  const sets = ['record.log=FULL', 'record.guidance=true', 'radio.preset=PC5_MODE4', 'run.warmup_s=60'];
  const args = ['--mode', 'in-process', '--quiet', '--duration', '300', '--out', join(folder, 'run')];
  await runToEnd([...args, ...sets.flatMap((set) => ['--set', set])]);
  execFileSync(join(programs, 'lukou'), ['report', join(folder, 'run')], { stdio: 'ignore' });
  browser = await chromium.launch({ executablePath: '/usr/bin/chromium', args: ['--no-sandbox'] });
});
after(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true, force: true });
});

/** The page and all that it complained about or asked for. */
async function open(options = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, offline: true, ...options });
  const page = await context.newPage();
  const heard = [];
  page.on('console', (message) => heard.push(message.text()));
  page.on('pageerror', (error) => heard.push(error.message));
  page.on('request', (request) => heard.push(request.url()));
  const url = `file://${join(folder, 'run', 'report.html')}`;
  await page.goto(url);
  return { page, foreign: () => heard.filter((text) => text !== url) };
}

test('opens without a network, asks for nothing and complains about nothing', async () => {
  const { page, foreign } = await open();
  await page.waitForSelector('canvas');
  assert.deepEqual(foreign(), []);
  assert.equal(await page.title(), 'Lukou: run');
  const figures = await page.$$eval('figure', (all) => all.map((figure) => figure.dataset.figure));
  const all = 'stop-time cumulative queue delay discharge time-space phase-plane radio advice safety fuel';
  assert.deepEqual([...figures].sort(), all.split(' ').sort());
  await page.close();
});

test('says the figures of summary.json', async () => {
  const { page } = await open();
  const summary = JSON.parse(readFileSync(join(folder, 'run', 'summary.json'), 'utf8'));
  const row = (label) => page.locator('tr', { has: page.locator(`th .en:text-is("${label}")`) }).locator('td');
  assert.equal(await row('mean delay [s]').nth(0).innerText(), summary.mean_delay_s.toFixed(2));
  assert.equal(await row('mean delay [s]').nth(1).innerText(), summary.equipped.mean_delay_s.toFixed(2));
  assert.equal(await row('encounters with TTC < 3 s').nth(0).innerText(), String(summary.safety.ttc));
  assert.equal(await row('fuel per vehicle [mL]').nth(0).innerText(), summary.fuel.mean_fuel_ml.toFixed(2));
  await page.close();
});

test('speaks Chinese when asked, in its charts too', async () => {
  const { page, foreign } = await open();
  await page.click('label[for="language-zh"]');
  await page.waitForFunction(() => document.title.startsWith('路口仿真'));
  assert.match(await page.innerText('figure[data-figure="queue"]'), /停车数/);
  assert.ok(!/[a-z]{4,} [a-z]{3,} [a-z]{3,}/.test(await page.innerText('figure[data-figure="queue"]')));
  assert.deepEqual(foreign(), []);
  await page.close();
});

test('shows its pictures where no script runs, and on paper', async () => {
  const { page } = await open({ javaScriptEnabled: false });
  const shown = page.locator('figure .en > svg:visible');
  const still = await shown.count();
  assert.equal(still, 11);
  await page.close();
  const scripted = await open();
  await scripted.page.waitForSelector('canvas');
  await scripted.page.emulateMedia({ media: 'print' });
  assert.equal(await scripted.page.locator('figure .en > svg:visible').count(), still);
  assert.equal(await scripted.page.locator('canvas:visible').count(), 0);
  await scripted.page.close();
});

test('is open to readers that do not see it', async () => {
  const { page } = await open();
  await page.waitForSelector('canvas');
  // The page forbids what it did not bring; the checker comes by the debugger's door.
  const found = await page.evaluate(`${axeSource}; axe.run({ runOnly: ['wcag2a', 'wcag2aa'] })`);
  assert.deepEqual(
    found.violations.map(({ id, nodes }) => `${id}: ${nodes[0].html.slice(0, 120)}`),
    [],
  );
  await page.close();
});
