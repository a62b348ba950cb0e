// node glb.mjs DIR: each tile by the Khronos validator. Extensions of 3D Tiles are unknown to it, and objects that only
// those use seem unused: hints. Anything worse is a fault.
import fs from 'node:fs';
import path from 'node:path';
import validator from 'gltf-validator';

const folder = path.join(process.argv[2], 'tiles');
const files = fs.readdirSync(folder);
let faults = 0;
for (const file of files) {
  const beside = async (uri) => new Uint8Array(fs.readFileSync(path.join(folder, uri)));
  const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(path.join(folder, file))), { externalResourceFunction: beside });
  for (const m of report.issues.messages) {
    if (m.severity > 1) continue;
    console.log(`${file} ${m.pointer}: ${m.code}: ${m.message}`);
    ++faults;
  }
}
console.log(`${files.length} tiles, ${faults} errors and warnings`);
process.exit(files.length > 0 && faults === 0 ? 0 : 1);
