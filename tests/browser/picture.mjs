// Makes docs/console.png: the page on a run of the paper's scenario, some minutes in.
//   node tests/browser/picture.mjs FILE
import { launch, openPage, startRun, stepOf, until } from './session.mjs';

const file = process.argv[2];
const browser = await launch();
const run = await startRun(['--pace', '100', '--seed', '1']);
try {
  const { page } = await openPage(browser, run.url, { colorScheme: 'light' });
  await until(async () => (await stepOf(page)) > 6000, 'ten minutes simulated', 60_000);
  run.ctl('pause', 'at', '700');
  await until(async () => (await stepOf(page)) === 7000, 'the pause');
  await page.waitForTimeout(1500);
  await page.screenshot({ path: file });
} finally {
  await browser.close();
  await run.end();
}
