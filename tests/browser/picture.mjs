// Makes docs/console.png: the page on a run of the paper's scenario, some minutes in.
//   node tests/browser/picture.mjs FILE
import { carsInSight } from './pixels.mjs';
import { launch, openPage, startRun, stepOf, until } from './session.mjs';

const file = process.argv[2];
const browser = await launch();
const run = await startRun(['--pace', '100', '--seed', '1']);
try {
  const { page, heard } = await openPage(browser, run.url, { colorScheme: 'light' });
  const reached = (step) => until(async () => (await stepOf(page)) >= step, `step ${step}`, 60_000);
  await reached(6000);
  run.ctl('pace', '10');
  await reached(7140); // some seconds before a green, when cars are guided to it
  run.ctl('pace', '1');
  await until(() => heard.status.paceAchieved < 1.1, 'real time');
  // With the card of a car that is guided, else of one that could be.
  const box = await page.locator('#picture').boundingBox();
  const place = (vehicle) => heard.picture.vehicle.indexOf(vehicle);
  const cars = carsInSight(heard.hello, heard.picture, box, 2.2).filter(
    ({ vehicle, equipped }) => equipped && heard.picture.state[place(vehicle)] !== 3,
  );
  const chosen = cars.find(({ vehicle }) => heard.picture.guidance[place(vehicle)] === 2) ?? cars.at(-1);
  if (chosen !== undefined) await page.mouse.click(box.x + chosen.spot.x, box.y + chosen.spot.y);
  await page.waitForTimeout(1500);
  await page.screenshot({ path: file });
} finally {
  await browser.close();
  await run.end();
}
