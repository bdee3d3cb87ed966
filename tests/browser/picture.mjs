// Makes docs/console.png: the page on a run of the paper's scenario, some minutes in, with the card of a guided car.
//   node tests/browser/picture.mjs FILE
import { carsInSight } from './pixels.mjs';
import { launch, openPage, startRun, stepOf, until } from './session.mjs';

const WINDOW = { width: 1360, height: 800 };
/** The queues have settled, and for how many steps a guided car is waited for: more than a cycle. */
const SETTLED = 6000;
const WITHIN = 1200;

const file = process.argv[2];
const browser = await launch();
const run = await startRun(['--pace', '100', '--seed', '1']);
try {
  const { page, heard } = await openPage(browser, run.url, { viewport: WINDOW, colorScheme: 'light' });
  await until(async () => (await stepOf(page)) >= SETTLED, `step ${SETTLED}`, 60_000);
  // A minute of closer pictures: the car's trail is made of them.
  run.ctl('pace', '10');
  await until(() => heard.status.paceAchieved < 12, 'ten times real time');
  const close = Number(heard.picture.step) + 600;
  await until(() => Number(heard.picture.step) > close, 'a minute', 60_000);
  run.ctl('pace', '1');
  await until(() => heard.status.paceAchieved < 1.1, 'real time');
  const last = Number(heard.picture.step) + WITHIN;
  const box = await page.locator('#picture').boundingBox();
  /** A car on advice that follows another, some way before its line and not under the card; only where much can be seen. */
  const guided = () => {
    const { picture } = heard;
    const seen = carsInSight(heard.hello, picture, box, 2.2);
    if (seen.length < 12) return undefined;
    return seen.find(({ vehicle, spot }) => {
      const i = picture.vehicle.indexOf(vehicle);
      const { lane, positionM, guidance, commandedMps2 } = picture;
      const acts = guidance[i] === 2 && Math.abs(commandedMps2[i]) > 0.15;
      const toLineM = heard.hello.lanes[lane[i]].stopLineM - positionM[i];
      const follows = i > 0 && lane[i - 1] === lane[i] && positionM[i - 1] - positionM[i] < 100;
      return (
        acts && follows && toLineM > 20 && (spot.x > 280 || (spot.y > 0.4 * box.height && spot.y < 0.6 * box.height))
      );
    });
  };
  const chosen = await until(() => guided() ?? Number(heard.picture.step) > last, 'a guided car', 180_000);
  if (chosen === true) throw new Error(`no guided car in sight by step ${last}`);
  await page.evaluate((car) => (location.hash += `&car=${car}`), chosen.vehicle);
  await until(() => heard.status.paceAchieved > 0.97 && heard.status.paceAchieved < 1.03, 'real time');
  await page.screenshot({ path: file });
} finally {
  await browser.close();
  await run.end();
}
