// Generates src/generated from idl/console.proto with protoc and protoc-gen-es; leaves it alone when it is newer.
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync, statSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const web = dirname(dirname(fileURLToPath(import.meta.url)));
const idl = join(web, '..', '..', '..', 'idl');
const source = join(idl, 'console.proto');
const target = join(web, 'src', 'generated', 'console_pb.ts');

if (!existsSync(target) || statSync(target).mtimeMs < statSync(source).mtimeMs) {
  mkdirSync(dirname(target), { recursive: true });
  const plugin = join(web, 'node_modules', '.bin', 'protoc-gen-es');
  execFileSync(
    'protoc',
    [
      `--plugin=protoc-gen-es=${plugin}`,
      `--es_out=${dirname(target)}`,
      '--es_opt=target=ts',
      `-I${idl}`,
      'console.proto',
    ],
    { stdio: 'inherit' },
  );
}
