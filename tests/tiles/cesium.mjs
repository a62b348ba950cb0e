// node cesium.mjs DIR [PICTURE.png]: opens the tileset in CesiumJS, in a headless browser, far and near. All tiles must
// load, pictures must show them, nothing may be said on the console, and what is picked must bring its attributes.
import fs from 'node:fs';
import http from 'node:http';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { chromium } from 'playwright-core';

const here = path.dirname(fileURLToPath(import.meta.url));
const [tiles, picture] = process.argv.slice(2);
const roots = { '/cesium/': path.join(here, 'node_modules/cesium/Build/Cesium'), '/tiles/': path.resolve(tiles) };
const types = { '.html': 'text/html', '.js': 'text/javascript', '.json': 'application/json', '.css': 'text/css', '.wasm': 'application/wasm' };
const seconds = 240; // a software renderer on a busy machine

function fileOf(url) {
  const name = decodeURIComponent(new URL(url, 'http://x').pathname);
  if (name === '/') return path.join(here, 'page.html');
  const prefix = Object.keys(roots).find((p) => name.startsWith(p));
  return prefix === undefined ? undefined : path.join(roots[prefix], path.normalize('/' + name.slice(prefix.length)));
}
const server = http.createServer((request, response) => {
  if (request.url === '/favicon.ico') return response.writeHead(204).end();
  const file = fileOf(request.url);
  if (file === undefined || !fs.existsSync(file)) return response.writeHead(404).end();
  response.writeHead(200, { 'content-type': types[path.extname(file)] ?? 'application/octet-stream' }).end(fs.readFileSync(file));
});
await new Promise((done) => server.listen(0, '127.0.0.1', done));
const base = `http://127.0.0.1:${server.address().port}`;

const faults = [];
const must = (holds, what) => { if (!holds) faults.push(what); };
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--disable-gpu', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-quic',
    '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync'],
});
try {
  const page = await browser.newPage({ viewport: picture ? { width: 960, height: 540 } : { width: 320, height: 200 } });
  page.setDefaultTimeout(1000 * seconds);
  page.on('console', (m) => { if (m.type() === 'error') faults.push(`console: ${m.text()}`); });
  page.on('pageerror', (e) => faults.push(`page: ${e}`));
  page.on('response', (r) => { if (r.status() >= 400) faults.push(`${r.status()} ${r.url()}`); });
  await page.goto(base + '/');
  await page.evaluate((url) => openTiles(url), `${base}/tiles/tileset.json`);
  const look = async (what, view) => {
    const seen = await page.evaluate((v) => look(v), { seconds: seconds / 3, ...view });
    console.log(`${what}: ${seen.selected} tiles, ${seen.triangles} triangles, ${(100 * seen.drawn).toFixed(1)} % of the picture`);
    must(seen.calm, `${what}: tiles were still loading`);
    must(seen.selected > 0 && seen.drawn > 0, `${what}: nothing is shown`);
    return seen;
  };
  const far = await look('far', { heading: 30, pitch: -35, range: 8 });
  must(far.selected === 1, 'from far the root alone is shown');
  const near = await look('near', { heading: 30, pitch: -40, range: 0.4 });
  must(near.selected > far.selected, 'near more tiles are shown');
  if (picture) fs.writeFileSync(picture, await page.screenshot());
  const features = await page.evaluate(() => pick(12, 8));
  const buildings = features.filter((f) => f.id !== undefined && f.class !== undefined && f.height > 0);
  const trees = features.filter((f) => typeof f.species === 'string' && f.species !== '' && f.height > 0);
  console.log(`picked: ${buildings.length} buildings, ${trees.length} trees`, buildings[0] ?? '', trees[0] ?? '');
  must(buildings.length > 0, 'no building was picked');
  faults.push(...await page.evaluate(() => failures));
} catch (error) {
  faults.push(String(error.message ?? error));
} finally {
  await browser.close().catch(() => {});
  server.close();
  server.closeAllConnections();
}
for (const fault of faults) console.log(`fault: ${fault}`);
process.exit(faults.length === 0 ? 0 : 1);
