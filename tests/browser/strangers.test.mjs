// A page of another site, open in the browser of somebody who watches a run.
import assert from 'node:assert/strict';
import { once } from 'node:events';
import { createServer } from 'node:http';
import { after, before, test } from 'node:test';

import { launch, openPage, startRun, stepOf, until } from './session.mjs';

let run;
let browser;
let site;

before(async () => {
  run = await startRun(['--pace', '10']);
  browser = await launch();
  site = createServer((_, response) => {
    response.setHeader('Content-Type', 'text/html');
    response.end('<!doctype html><title>elsewhere</title><p>elsewhere</p>');
  });
  site.listen(0, '127.0.0.1');
  await once(site, 'listening');
});
after(async () => {
  site?.close();
  await browser?.close();
  await run?.end();
});

/** What a script of the page at `from` gets: it opens the console's socket, takes control and stops the run; it reads the page. */
async function attempt(from) {
  const context = await browser.newContext();
  const page = await context.newPage();
  await page.goto(from);
  const got = await page.evaluate(async (console) => {
    const socket = await new Promise((resolve) => {
      const opened = new WebSocket(`${console.replace('http', 'ws')}ws`);
      let messages = 0;
      opened.onmessage = () => ++messages;
      opened.onopen = () => {
        opened.send(new Uint8Array([26, 2, 8, 1])); // take control, also from another
        opened.send(new Uint8Array([18, 8, 8, 1, 18, 4, 115, 116, 111, 112])); // request 1: "stop"
        setTimeout(() => resolve(messages > 0 ? 'open' : 'silent'), 1500);
      };
      opened.onclose = () => resolve('closed');
    });
    const file = await fetch(console).then(
      (response) => String(response.status),
      () => 'refused',
    );
    const frame = document.createElement('iframe');
    frame.src = console;
    document.body.append(frame);
    await new Promise((resolve) => (frame.onload = resolve));
    let framed = 'hidden';
    try {
      framed = frame.contentDocument?.title ?? 'hidden';
    } catch {
      // Of another origin: not to be looked into.
    }
    return { socket, file, framed };
  }, run.url);
  await context.close();
  return got;
}

test(
  'a page of another site gets no socket, no file and no frame, and harms nothing',
  { timeout: 60_000 },
  async () => {
    const { page, heard, close } = await openPage(browser, run.url);
    await page.getByRole('button', { name: 'Take control' }).click();
    await page.getByText('You control').waitFor();
    const elsewhere = `127.0.0.1:${site.address().port}/`;
    for (const from of [`http://${elsewhere}`, `http://${elsewhere.replace('127.0.0.1', 'localhost')}`]) {
      assert.deepEqual(await attempt(from), { socket: 'closed', file: 'refused', framed: 'hidden' }, from);
    }
    await page.getByText('You control').waitFor();
    await page.getByText('1 watching').waitFor();
    const step = await stepOf(page);
    await until(async () => (await stepOf(page)) > step, 'the run goes on');
    // The attempt is sound: from the console's own origin it gets in, and stops the run.
    assert.deepEqual(await attempt(run.url).then(({ socket, file }) => [socket, file]), ['open', '200']);
    await until(() => heard.status.phase === 'ended', 'the end');
    await close();
  },
);
