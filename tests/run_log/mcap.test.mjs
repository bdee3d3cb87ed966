// The run log as others read it: with the mcap project's own reader, and with the descriptors that the file holds.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';

const root = dirname(dirname(dirname(fileURLToPath(import.meta.url))));
const require = createRequire(join(root, 'services', 'console', 'web', 'package.json'));
const { McapIndexedReader, McapStreamReader } = require('@mcap/core');
const { loadDecompressHandlers } = require('@mcap/support');
const { createFileRegistry, fromBinary } = require('@bufbuild/protobuf');
const { FileDescriptorSetSchema } = require('@bufbuild/protobuf/wkt');

const lukou = join(process.env.LUKOU_BIN ?? join(root, 'build', 'bin'), 'lukou');
const STEPS = 1200;
const STEP_NS = 100_000_000n;

let folder;
let bytes;
let decompressHandlers;

before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'lukou-run-log-'));
  execFileSync(
    lukou,
    ['run', 'paper', '--mode', 'in-process', '--quiet', '--duration', '120', '--out', join(folder, 'run')].concat([
      '--set',
      'record.log=FULL',
      '--set',
      'radio.preset=PC5_MODE4',
    ]),
    { stdio: 'ignore' },
  );
  bytes = readFileSync(join(folder, 'run', 'run.mcap'));
  decompressHandlers = await loadDecompressHandlers();
});
after(() => rmSync(folder, { recursive: true, force: true }));

/** Reads from memory as from a file. */
const readable = (data) => ({
  size: async () => BigInt(data.length),
  read: async (offset, size) => data.subarray(Number(offset), Number(offset + size)),
});
const open = () => McapIndexedReader.Initialize({ readable: readable(bytes), decompressHandlers });

/** Decodes messages by the descriptors in the file, not by ours. */
function decoder(reader) {
  const types = new Map();
  for (const [id, channel] of reader.channelsById) {
    const schema = reader.schemasById.get(channel.schemaId);
    assert.equal(schema.encoding, 'protobuf');
    const registry = createFileRegistry(fromBinary(FileDescriptorSetSchema, schema.data));
    types.set(id, registry.getMessage(schema.name));
  }
  return (message) => fromBinary(types.get(message.channelId), message.data);
}

/** A table as rows of texts by column. */
function table(name) {
  const [head, ...lines] = readFileSync(join(folder, 'run', name), 'utf8')
    .trimEnd()
    .split('\n');
  const columns = head.split(',');
  return lines.map((line) => Object.fromEntries(line.split(',').map((cell, i) => [columns[i], cell])));
}

test('has the channels and types that docs/run-log.md names', async () => {
  const reader = await open();
  const channels = [...reader.channelsById.values()].map((channel) => channel.topic);
  assert.deepEqual(channels, ['/directive', '/signal', '/events', '/cars', '/reception', '/air', '/roadside']);
  const types = [...reader.schemasById.values()].map((schema) => schema.name);
  assert.deepEqual(
    types,
    ['Directive', 'Signal', 'Events', 'Cars', 'Reception', 'Air', 'Roadside'].map((name) => `lukou.record.${name}`),
  );
  const metadata = [];
  for await (const record of reader.readMetadata({ name: 'lukou' })) metadata.push(record.metadata);
  assert.equal(metadata.length, 1);
  assert.equal(metadata[0].get('level'), 'FULL');
  assert.equal(metadata[0].get('scenario'), readFileSync(join(folder, 'run', 'scenario.textproto'), 'utf8'));
});

test('counts a message a step on the channels of every step, from 0 s to the end', async () => {
  const reader = await open();
  const counts = reader.statistics.channelMessageCounts;
  const of = (topic) => counts.get([...reader.channelsById.values()].find((channel) => channel.topic === topic).id);
  for (const topic of ['/events', '/cars', '/air', '/roadside']) assert.equal(of(topic), BigInt(STEPS + 1), topic);
  assert.equal(reader.statistics.messageStartTime, 0n);
  assert.equal(reader.statistics.messageEndTime, BigInt(STEPS) * STEP_NS);
  const stride = 5; // of the signal controller
  assert.equal(of('/signal'), BigInt(Math.floor((STEPS - 6) / stride) + 1));
});

test('holds of a car what car.csv says of it', async () => {
  const reader = await open();
  const decode = decoder(reader);
  const entered = new Map();
  const crossed = new Map();
  const left = new Map();
  const seen = new Map();
  for await (const message of reader.readMessages({ topics: ['/events', '/cars'] })) {
    const content = decode(message);
    if (content.$typeName === 'lukou.record.Events') {
      content.enteredVehicle.forEach((car, i) => entered.set(car, content.enteredSpeedMps[i]));
      content.crossedVehicle.forEach((car, i) => crossed.set(car, content.crossedTimeS[i]));
      content.leftVehicle.forEach((car, i) => left.set(car, content.leftTimeS[i]));
      continue;
    }
    content.vehicle.forEach((car, i) => {
      if (!seen.has(car)) seen.set(car, { time: Number(message.logTime / STEP_NS) / 10, speed: content.speedMps[i] });
    });
  }
  const cars = table('car.csv');
  assert.ok(cars.length > 50, `${cars.length} cars`);
  const near = (a, b) => assert.ok(Math.abs(a - Number(b)) <= 1e-6, `${a} ${b}`);
  for (const row of cars) {
    const car = Number(row.vehicle);
    near(entered.get(car), row.init_velocity_mps);
    near(seen.get(car).speed, row.init_velocity_mps);
    near(seen.get(car).time, row.entered_s);
    near(crossed.get(car) - Number(row.entered_s), row.act_time_s);
    near(left.get(car), row.left_s);
  }
});

test('tells of each frame of a car at the RSU as often as radio.csv counts', async () => {
  const reader = await open();
  const decode = decoder(reader);
  let lost = 0;
  let frames = 0;
  for await (const message of reader.readMessages({ topics: ['/reception'] })) {
    const content = decode(message);
    frames += content.uplinkFate.length;
    lost += content.uplinkFate.filter((fate) => fate > 0).length;
  }
  const uplink = table('radio.csv').filter((row) => row.direction === 'uplink');
  const sum = (column) => uplink.reduce((total, row) => total + Number(row[column]), 0);
  const causes = ['random', 'burst', 'range', 'path_loss', 'collision', 'half_duplex', 'outage'];
  assert.equal(frames, sum('sent'));
  assert.equal(
    lost,
    causes.reduce((total, cause) => total + sum(`lost_${cause}`), 0),
  );
  assert.ok(lost > 0);
});

test('cut at 50 places gives a stream reader every message of every whole chunk', async () => {
  const reader = await open();
  const chunks = [...reader.chunkIndexes].sort((a, b) => Number(a.chunkStartOffset - b.chunkStartOffset));
  const perChunk = [];
  for (const chunk of chunks) {
    let count = 0;
    const within = { startTime: chunk.messageStartTime, endTime: chunk.messageEndTime };
    for await (const message of reader.readMessages(within)) count += message ? 1 : 0;
    perChunk.push(count);
  }
  const first = Number(chunks[0].chunkStartOffset);
  for (let i = 0; i < 50; ++i) {
    const size = first + ((i * 618_033) % (bytes.length - first));
    const stream = new McapStreamReader({ decompressHandlers });
    stream.append(bytes.subarray(0, size));
    let messages = 0;
    for (let record = stream.nextRecord(); record; record = stream.nextRecord()) {
      messages += record.type === 'Message' ? 1 : 0;
    }
    const whole = chunks.filter((chunk) => Number(chunk.chunkStartOffset + chunk.chunkLength) <= size).length;
    const expected = perChunk.slice(0, whole).reduce((total, count) => total + count, 0);
    assert.equal(messages, expected, `cut at byte ${size}`);
  }
});
