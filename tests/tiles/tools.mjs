// node tools.mjs DIR: 3d-tiles-tools walk the tileset, which reads each tile and each of its metadata, pack it into one
// file and unpack that: all files must come back.
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { fileURLToPath } from 'node:url';

const from = path.resolve(process.argv[2]);
const work = fs.mkdtempSync(path.join(os.tmpdir(), 'manzana-tiles-'));
const cli = path.join(path.dirname(fileURLToPath(import.meta.url)), 'node_modules/3d-tiles-tools/build/src/cli.mjs');
function tools(...args) {
  const ended = spawnSync(process.execPath, [cli, ...args], { encoding: 'utf8' });
  if (ended.status !== 0) throw new Error(`${args[0]}: ${ended.stdout}${ended.stderr}`);
}
const files = (folder) => fs.readdirSync(folder, { recursive: true }).filter((f) => fs.statSync(path.join(folder, f)).isFile()).sort();

try {
  const packed = path.join(work, 'city.3tz'), back = path.join(work, 'back');
  tools('convert', '-i', path.join(from, 'tileset.json'), '-o', packed);
  tools('convert', '-i', packed, '-o', back);
  const before = files(from), after = files(back);
  if (before.join() !== after.join()) throw new Error(`${before.length} files became ${after.length}`);
  for (const file of before) {
    const [a, b] = [from, back].map((folder) => fs.readFileSync(path.join(folder, file)));
    const same = file.endsWith('.json') ? JSON.stringify(JSON.parse(a)) === JSON.stringify(JSON.parse(b)) : a.equals(b);
    if (!same) throw new Error(`${file} came back as another`);
  }
  tools('analyze', '-i', path.join(from, 'tiles/0-city.glb'), '-o', path.join(work, 'analysed'));
  console.log(`${before.length} files there and back`);
} catch (error) {
  console.log(String(error.message ?? error));
  process.exitCode = 1;
} finally {
  fs.rmSync(work, { recursive: true, force: true });
}
