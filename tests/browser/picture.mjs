// Makes docs/console.png: the page on a run of the paper's scenario, some minutes in.
//   node tests/browser/picture.mjs FILE
import { carsInSight } from './pixels.mjs';
import { launch, openPage, startRun, stepOf, until } from './session.mjs';

const file = process.argv[2];
const browser = await launch();
const run = await startRun(['--pace', '100', '--seed', '1']);
try {
  const { page, heard } = await openPage(browser, run.url, { colorScheme: 'light' });
  await until(async () => (await stepOf(page)) > 6000, 'ten minutes simulated', 60_000);
  run.ctl('pause', 'at', '700');
  await until(async () => (await stepOf(page)) === 7000, 'the pause');
  // With the card of a guided car.
  const picture = page.locator('#picture');
  const box = await picture.boundingBox();
  const guided = carsInSight(heard.hello, heard.picture, box, 2.2).find(
    ({ vehicle, spot }) => heard.picture.guidance[heard.picture.vehicle.indexOf(vehicle)] === 2 && spot.x > 270,
  );
  if (guided !== undefined) await page.mouse.click(box.x + guided.spot.x, box.y + guided.spot.y);
  await page.waitForTimeout(1500);
  await page.screenshot({ path: file });
} finally {
  await browser.close();
  await run.end();
}
