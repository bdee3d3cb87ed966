// Makes docs/console.png: the page on a run of the paper's scenario, some minutes in, with the card of a guided car.
//   node tests/browser/picture.mjs FILE
import { carsInSight } from './pixels.mjs';
import { launch, openPage, startRun, stepOf, until } from './session.mjs';

const WINDOW = { width: 1360, height: 800 };
/** Steps before and after a green of the north and the south begins: cars are guided to it, others still cross. */
const FROM = 7080;
const TO = 7400;

const file = process.argv[2];
const browser = await launch();
const run = await startRun(['--pace', '100', '--seed', '1']);
try {
  const { page, heard } = await openPage(browser, run.url, { viewport: WINDOW, colorScheme: 'light' });
  const reached = (step) => until(async () => (await stepOf(page)) >= step, `step ${step}`, 60_000);
  await reached(6000);
  run.ctl('pace', '10');
  await reached(FROM);
  run.ctl('pace', '1');
  const box = await page.locator('#picture').boundingBox();
  /** A car that advice brakes or speeds up, still before its line and not under the card; only where much can be seen. */
  const guided = () => {
    const { picture } = heard;
    const seen = carsInSight(heard.hello, picture, box, 2.2);
    if (seen.length < 12 || new Set(picture.heads).size < 2) return undefined;
    return seen.find(({ vehicle, spot }) => {
      const i = picture.vehicle.indexOf(vehicle);
      const acts = picture.guidance[i] === 2 && Math.abs(picture.commandedMps2[i]) > 0.3 && picture.state[i] !== 3;
      return acts && (spot.x > 280 || (spot.y > 0.4 * box.height && spot.y < 0.6 * box.height));
    });
  };
  const chosen = await until(() => guided() ?? Number(heard.picture.step) > TO, 'a guided car', 60_000);
  if (chosen === true) throw new Error(`no guided car in sight by step ${TO}`);
  await page.evaluate((car) => (location.hash += `&car=${car}`), chosen.vehicle);
  await until(() => heard.status.paceAchieved > 0.97 && heard.status.paceAchieved < 1.03, 'real time');
  await page.screenshot({ path: file });
} finally {
  await browser.close();
  await run.end();
}
