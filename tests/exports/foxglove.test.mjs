// The scene for Foxglove as the mcap project's reader and the file's own descriptors show it.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { after, test } from 'node:test';
import { fileURLToPath } from 'node:url';

const root = dirname(dirname(dirname(fileURLToPath(import.meta.url))));
const require = createRequire(join(root, 'services', 'console', 'web', 'package.json'));
const { McapIndexedReader } = require('@mcap/core');
const { loadDecompressHandlers } = require('@mcap/support');
const { createFileRegistry, fromBinary } = require('@bufbuild/protobuf');
const { FileDescriptorSetSchema } = require('@bufbuild/protobuf/wkt');

const lukou = join(process.env.LUKOU_BIN ?? join(root, 'build', 'bin'), 'lukou');
const folder = mkdtempSync(join(tmpdir(), 'lukou-scene-'));
after(() => rmSync(folder, { recursive: true, force: true }));

test('draws roads once, heads when they change, every car at every instant', async () => {
  const result = join(folder, 'run');
  const run = ['run', 'paper', '--mode', 'in-process', '--quiet', '--duration', '120', '--out', result];
  execFileSync(lukou, [...run, '--set', 'record.log=FULL'], { stdio: 'ignore' });
  const convert = (format, out) =>
    execFileSync(lukou, ['export', result, '--format', format, '--period', '1s', '--out', join(folder, out)], {
      stdio: 'ignore',
    });
  convert('foxglove', 'scene.mcap');
  convert('csv', 'csv');
  const bytes = readFileSync(join(folder, 'scene.mcap'));
  const readable = {
    size: async () => BigInt(bytes.length),
    read: async (offset, size) => bytes.subarray(Number(offset), Number(offset + size)),
  };
  const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers: await loadDecompressHandlers() });
  const [channel] = [...reader.channelsById.values()];
  assert.equal(channel.topic, '/scene');
  const schema = reader.schemasById.get(channel.schemaId);
  assert.equal(schema.name, 'foxglove.SceneUpdate');
  const type = createFileRegistry(fromBinary(FileDescriptorSetSchema, schema.data)).getMessage(schema.name);

  const rows = readFileSync(join(folder, 'csv', 'trajectories.csv'), 'utf8')
    .trimEnd()
    .split('\n')
    .slice(1);
  const counts = new Map();
  for (const row of rows) {
    const time = Number(row.split(',')[0]);
    counts.set(time, (counts.get(time) ?? 0) + 1);
  }
  const times = [];
  const heads = [];
  let roads = 0;
  for await (const message of reader.readMessages()) {
    const { entities } = fromBinary(type, message.data);
    const time = Number(message.logTime) / 1e9;
    times.push(time);
    const of = (id) => entities.find((entity) => entity.id === id);
    assert.ok(entities.every((entity) => entity.frameId === 'map' && Number(entity.timestamp.seconds) === time));
    assert.equal(of('cars').cubes.length, counts.get(time) ?? 0, `cars at ${time} s`);
    roads += of('roads') ? 1 : 0;
    if (of('heads')) heads.push(time);
    // Nobody is off the map: 500 m and the car before the stop line, which is 15.5 m from the centre.
    for (const { pose } of of('cars').cubes) {
      assert.ok(Math.hypot(pose.position.x, pose.position.y) < 525);
      assert.ok(Math.abs(Math.hypot(pose.orientation.z, pose.orientation.w) - 1) < 1e-9);
    }
  }
  assert.deepEqual(
    times,
    Array.from({ length: 121 }, (_, second) => second),
  );
  assert.equal(roads, 1);
  assert.deepEqual(heads, [0, 45, 90]); // the paper's plan: 45 s each
});
