// What the page costs and how quick it is. Prints figures; judges nothing.
//   node tests/browser/benchmark.mjs [--minutes N]     with N: only the memory, over N minutes of two viewers at 100x
import { readdirSync, readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { gzipSync } from 'node:zlib';

import { launch, memberPid, openPage, programs, startRun, stepOf, until } from './session.mjs';

const minutes = Number(process.argv[process.argv.indexOf('--minutes') + 1] ?? 0) || 0;
const line = (name, value, goal = '') => console.log(`${name.padEnd(52)} ${String(value).padStart(12)}   ${goal}`);
const median = (values) => values.sort((a, b) => a - b)[Math.floor(values.length / 2)];

function pageSize() {
  const folder = join(dirname(programs), 'console');
  const files = readdirSync(folder, { recursive: true, withFileTypes: true }).filter((entry) => entry.isFile());
  const bytes = files.map(
    (entry) => gzipSync(readFileSync(join(entry.parentPath ?? entry.path, entry.name)), { level: 9 }).length,
  );
  line('page, all files gzipped [kB]', (bytes.reduce((sum, n) => sum + n, 0) / 1000).toFixed(1), 'goal: at most 120');
}

/** Time from the navigation to the first picture on the screen [ms]. */
async function firstPicture(browser, url) {
  const times = [];
  for (let i = 0; i < 5; ++i) {
    const context = await browser.newContext({ viewport: { width: 1280, height: 720 } });
    const page = await context.newPage();
    await page.addInitScript(() => {
      const watch = () => {
        if (document.querySelector('#picture[data-frames]')) window.firstPictureMs = performance.now();
        else requestAnimationFrame(watch);
      };
      watch();
    });
    await page.goto(url);
    times.push(
      await page.waitForFunction(() => window.firstPictureMs, undefined, { polling: 20 }).then((h) => h.jsonValue()),
    );
    await context.close();
  }
  line('first picture after the navigation, median of 5 [ms]', median(times).toFixed(0), 'goal: 1000');
}

/** Time from the key that sends a flow to the directive's echo [ms]; includes the way from this script into the browser. */
async function echo({ page, heard }) {
  const times = [];
  const west = page.getByRole('spinbutton', { name: 'West' });
  for (let i = 0; i < 10; ++i) {
    await west.fill(String(1801 + i));
    const before = heard.events.length;
    const from = performance.now();
    await west.press('Enter');
    await until(() => heard.events.length > before, 'the echo');
    times.push(performance.now() - from);
    await page.waitForTimeout(137);
  }
  line('value to echo at 1x, median of 10 [ms]', median(times).toFixed(0), 'goal: 150');
}

async function frames({ page, heard }, view) {
  await page.getByRole('group', { name: 'Intersection' }).getByRole('button', { name: view }).click();
  await page.waitForTimeout(1000);
  const { drawn, offered, worstMs } = await page.evaluate(
    () =>
      new Promise((resolve) => {
        const picture = document.getElementById('picture');
        const from = Number(picture.dataset.frames);
        const begin = performance.now();
        let offered = 0;
        let last = begin;
        let worstMs = 0;
        requestAnimationFrame(function next(now) {
          ++offered;
          worstMs = Math.max(worstMs, now - last);
          last = now;
          if (now - begin < 8000) requestAnimationFrame(next);
          else resolve({ drawn: (Number(picture.dataset.frames) - from) / 8, offered: offered / 8, worstMs });
        });
      }),
  );
  const cars = heard.picture.vehicle.length;
  line(
    `frames a second, ${view}, ${cars} cars on the road`,
    drawn.toFixed(1),
    `goal: 60; browser offers ${offered.toFixed(1)}, longest gap ${worstMs.toFixed(0)} ms`,
  );
  line('   pace meanwhile, asked 1', heard.status.paceAchieved.toFixed(2));
}

/** Growth of values taken once a minute, by least squares [units per hour]. */
function slopePerHour(values) {
  const mean = (numbers) => numbers.reduce((sum, n) => sum + n, 0) / numbers.length;
  const minute = values.map((_, i) => i - (values.length - 1) / 2);
  const middle = mean(values);
  return (60 * mean(minute.map((t, i) => t * (values[i] - middle)))) / mean(minute.map((t) => t * t));
}

/** Memory of the server and of the scripts of two pages, minute by minute; the first ten fill the stores. */
async function memory(browser, run) {
  const server = memberPid(run, 'lukou-console');
  const rss = () => Number(readFileSync(`/proc/${server}/status`, 'utf8').match(/VmRSS:\s+(\d+)/)[1]) / 1000;
  const viewers = [await openPage(browser, run.url), await openPage(browser, run.url)];
  const heap = async ({ page }) => {
    const session = await page.context().newCDPSession(page);
    await session.send('HeapProfiler.collectGarbage');
    const { usedSize, backingStorageSize = 0 } = await session.send('Runtime.getHeapUsage');
    await session.detach();
    return (usedSize + backingStorageSize) / 1e6;
  };
  run.ctl('pace', '100');
  const settled = [[], [], []];
  console.log('minutes at 100x: server, one page, the other [MB]; growth since minute 10 [MB/h]; pace');
  for (let minute = 0; minute <= minutes; ++minute) {
    if (minute > 0) await viewers[0].page.waitForTimeout(60_000);
    const { phase } = viewers[0].heard.status;
    if (phase !== 'running') throw new Error(`the run is ${phase} after minute ${minute}`);
    const now = [rss(), await heap(viewers[0]), await heap(viewers[1])];
    if (minute >= 10) now.forEach((value, i) => settled[i].push(value));
    const growth = minute > 12 ? settled.map((values) => slopePerHour(values).toFixed(2)).join(', ') : '-';
    const pace = viewers[0].heard.status.paceAchieved.toFixed(0);
    console.log(
      `${String(minute).padStart(3)}   ${now.map((mb) => mb.toFixed(1)).join(', ')}   ${growth}   ${pace}x, step ${viewers[0].heard.picture.step}`,
    );
  }
}

/** Size, first picture, echo and frames. 2000 m of approach hold about 300 cars at 1800 veh/h each. */
async function quickness(browser) {
  const run = await startRun(['--pace', 'max', '--duration', '20000', '--set', 'traffic.approach_length_m=2000']);
  try {
    const viewer = await openPage(browser, run.url);
    await until(async () => (await stepOf(viewer.page)) > 4000, '400 s simulated', 120_000);
    run.ctl('pace', '1');
    await until(() => viewer.heard.status.paceAchieved < 1.5, 'real time');
    await firstPicture(browser, run.url);
    await echo(viewer);
    await frames(viewer, 'Last 50 m');
    await frames(viewer, 'Whole approach');
    await viewer.close();
  } finally {
    await run.end();
  }
}

/** Without a watchdog: a machine with other work may hold a process up for longer than a watched run stands. */
async function longRun(browser) {
  const run = await startRun(['--no-watchdog', '--pace', '100', '--duration', String(6000 * (minutes + 2))]);
  try {
    await memory(browser, run);
  } finally {
    await run.end();
  }
}

const browser = await launch();
try {
  if (minutes > 0) {
    await longRun(browser);
  } else {
    pageSize();
    await quickness(browser);
  }
} finally {
  await browser.close();
}
