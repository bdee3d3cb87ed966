// Starts real runs and opens the real page on them. Everything that is started here is ended by its pid.
import { execFileSync, spawn } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const root = dirname(dirname(dirname(fileURLToPath(import.meta.url))));
export const web = join(root, 'services', 'console', 'web');
const require = createRequire(join(web, 'package.json'));
export const { chromium } = require('playwright-core');
export const axeSource = require('axe-core').source;

/** Folder of the programs under test. */
export const programs = process.env.LUKOU_BIN ?? join(root, 'build', 'bin');
const lukou = join(programs, 'lukou');
const environment = { ...process.env, LUKOU_SCENARIOS: join(root, 'launch_scripts', 'scenarios') };

const URL_LINE = /https?:\/\/[\d.]+:\d+\/\S*/;

const children = new Set();
process.on('exit', () => children.forEach((child) => child.kill('SIGTERM')));
for (const signal of ['SIGINT', 'SIGTERM']) process.on(signal, () => process.exit(1));

class Process {
  constructor(command, args, extra = {}) {
    this.output = '';
    this.child = spawn(command, args, { env: { ...environment, ...extra }, stdio: ['ignore', 'pipe', 'pipe'] });
    children.add(this.child);
    for (const stream of [this.child.stdout, this.child.stderr]) {
      stream.setEncoding('utf8');
      stream.on('data', (text) => (this.output += text));
    }
    this.ended = new Promise((resolve) => this.child.on('exit', (code, signal) => resolve(code ?? signal)));
    void this.ended.then(() => children.delete(this.child));
  }

  async end(signal = 'SIGINT') {
    this.child.kill(signal);
    // A run that has ended is still shown to whoever looks; a second interrupt ends that too.
    const again = setInterval(() => {
      if (!this.output.includes('shows the end')) return;
      this.child.kill(signal);
      clearInterval(again);
    }, 100);
    const killer = setTimeout(() => this.child.kill('SIGKILL'), 15_000);
    const code = await this.ended;
    clearTimeout(killer);
    clearInterval(again);
    return code;
  }
}

/** Waits until `probe` gives something true, and gives it. */
export async function until(probe, what, limitMs = 20_000) {
  const end = Date.now() + limitMs;
  for (;;) {
    const found = await probe();
    if (found) return found;
    if (Date.now() > end) throw new Error(`${what}: not within ${limitMs / 1000} s`);
    await new Promise((resolve) => setTimeout(resolve, 25));
  }
}

/** A run with its console: `url` of the page, `id` of the run, `out` its results. */
export async function startRun(args = [], scenario = 'paper') {
  const folder = mkdtempSync(join(tmpdir(), 'lukou-browser-'));
  const out = join(folder, 'result');
  const started = new Process(lukou, ['run', scenario, `--console=${firstPort()}`, '--out', out, ...args]);
  try {
    const url = await until(() => started.output.match(URL_LINE)?.[0], `address of the console in: ${started.output}`);
    const id = await until(() => runIds().find((found) => started.output.includes(found)), 'id of the run');
    return {
      url,
      id,
      out,
      process: started,
      ctl: (...request) => execFileSync(lukou, ['ctl', id, ...request], { env: environment, encoding: 'utf8' }),
      async end() {
        const code = await started.end();
        rmSync(folder, { recursive: true, force: true });
        return code;
      },
    };
  } catch (error) {
    await started.end('SIGTERM');
    throw new Error(`${error.message}\n${started.output}`);
  }
}

/** The server takes this port or the next that is free: far from where people look, different for every test program. */
const firstPort = () => 20_000 + (process.pid % 20_000);

function runIds() {
  const listed = execFileSync(lukou, ['ctl', 'list'], { env: environment, encoding: 'utf8' });
  return listed
    .split('\n')
    .map((line) => line.split(/\s+/)[0])
    .filter((id) => id !== '');
}

/** Runs without a console, to the end. */
export async function runToEnd(args, scenario = 'paper') {
  const run = new Process(lukou, ['run', scenario, ...args]);
  const code = await run.ended;
  if (code !== 0) throw new Error(`exit code ${code}\n${run.output}`);
}

/** A recorded run with a console on it. */
export async function startReplay(result) {
  const started = new Process(lukou, ['replay', result, `--console=${firstPort()}`]);
  try {
    const url = await until(() => started.output.match(URL_LINE)?.[0], `address of the console in: ${started.output}`);
    return { url, end: () => started.end() };
  } catch (error) {
    await started.end('SIGTERM');
    throw error;
  }
}

/** A second console on a run. */
export async function attach(id, port = 0) {
  const console = new Process(join(programs, 'lukou-console'), ['--attach', id, '--port', String(port)]);
  const url = await until(() => console.output.match(URL_LINE)?.[0], `address of the console in: ${console.output}`);
  return { url, end: (signal) => console.end(signal) };
}

/** Pid of one of the processes that a run started. */
export function memberPid(run, program) {
  const parent = String(run.process.child.pid);
  const listed = execFileSync('ps', ['-o', 'pid=,args=', '--ppid', parent], { encoding: 'utf8' });
  const line = listed.split('\n').find((text) => text.includes(program));
  if (line === undefined) throw new Error(`no ${program} among: ${listed}`);
  return Number(line.trim().split(/\s+/)[0]);
}

export function launch() {
  return chromium.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: ['--no-sandbox'],
  });
}

/** Opens the page and waits for its first picture. Errors of the page fail the test that looks at `errors`. */
export async function openPage(browser, url, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 720 }, locale: 'en', ...options });
  const page = await context.newPage();
  const errors = [];
  page.on('pageerror', (error) => errors.push(String(error)));
  page.on('console', (message) => {
    if (message.type() === 'error') errors.push(message.text());
  });
  const heard = listen(page);
  await page.goto(url);
  await page.locator('#picture[data-step]').waitFor({ timeout: 20_000 });
  return { page, errors, heard, close: () => context.close() };
}

let registry;
/** A message of the contract between server and page. */
function schemaOf(name) {
  if (registry === undefined) {
    const folder = mkdtempSync(join(tmpdir(), 'lukou-proto-'));
    const file = join(folder, 'console.binpb');
    execFileSync('protoc', [`--descriptor_set_out=${file}`, `-I${join(root, 'idl')}`, 'console.proto']);
    const { createFileRegistry, fromBinary } = require('@bufbuild/protobuf');
    const { FileDescriptorSetSchema } = require('@bufbuild/protobuf/wkt');
    const set = fromBinary(FileDescriptorSetSchema, require('node:fs').readFileSync(file));
    registry = createFileRegistry(set);
    rmSync(folder, { recursive: true });
  }
  return registry.getMessage(`lukou.console.${name}`);
}

/** A message to the page as it goes over the wire: `encoded('picture', { ... })`. */
export function encoded(kind, value) {
  const { create, toBinary } = require('@bufbuild/protobuf');
  const schema = schemaOf('ToPage');
  const inner = schema.fields.find((field) => field.localName === kind).message;
  const what = { case: kind, value: create(inner, value) };
  return Buffer.from(toBinary(schema, create(schema, { what })));
}

/** What the page says, decoded: `{ case, value }`. */
export function decoded(bytes) {
  const { fromBinary } = require('@bufbuild/protobuf');
  return fromBinary(schemaOf('FromPage'), bytes).what;
}

/** Collects what the server tells the page: the newest of each kind, and every event. */
function listen(page) {
  const { fromBinary } = require('@bufbuild/protobuf');
  const heard = { pictures: [], events: [] };
  page.on('websocket', (socket) => {
    socket.on('framereceived', ({ payload }) => {
      if (typeof payload === 'string') return;
      const { what } = fromBinary(schemaOf('ToPage'), payload);
      heard[what.case] = what.value;
      if (what.case === 'picture') heard.pictures.push(what.value);
      if (what.case === 'event') heard.events.push(what.value);
      if (heard.pictures.length > 50) heard.pictures.shift();
    });
  });
  return heard;
}

/** The changes that the run has told of. */
export const directives = (heard) => heard.events.filter(({ kind }) => kind === 'directive');

/** Moves a slider by a click at a share of its width. */
export async function slideTo(page, slider, share) {
  const box = await slider.boundingBox();
  await page.mouse.click(box.x + 8 + (box.width - 16) * share, box.y + box.height / 2);
}

/** The picture's step, as it is drawn. */
export const stepOf = (page) => page.locator('#picture').getAttribute('data-step').then(Number);

/** Serious and critical findings of axe-core, in short. */
export async function axeFindings(page) {
  await page.evaluate(axeSource);
  const { violations } = await page.evaluate(() => window.axe.run(document, { resultTypes: ['violations'] }));
  return violations
    .filter(({ impact }) => impact === 'serious' || impact === 'critical')
    .map(({ id, impact, nodes }) => `${impact} ${id}: ${nodes.map((node) => node.html.slice(0, 120)).join(' | ')}`);
}
