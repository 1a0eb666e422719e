// node appearance.cjs PIXELS SCENE.glb FILE.glb...: prints PSNR, SSIM and FLIP of each FILE against SCENE, over 24 views in which the
// scene's bounding sphere spans PIXELS. All files lie in one folder. MATERIALS=own: as their materials answer to light; form: in one grey;
// flat: the same, by the normals of faces, not by those of files; else colours only. UP=z: this axis of the files points up (default: y).
// Packages are those of tests/viewers/run.sh (NODE_PATH).
const fs = require('fs'), http = require('http'), path = require('path');
const { chromium } = require('playwright-core');
const [pixels, ...files] = process.argv.slice(2);
const folders = { node_modules: process.env.NODE_PATH, pages: __dirname, data: path.dirname(path.resolve(files[0])) };
const types = { '.html': 'text/html', '.js': 'text/javascript', '.mjs': 'text/javascript', '.wasm': 'application/wasm' };
const server = http.createServer((request, response) => {
  const [, top, ...rest] = decodeURIComponent(new URL(request.url, 'http://x').pathname).split('/');
  fs.readFile(path.join(folders[top] || '/nowhere', ...rest), (error, data) => {
    response.writeHead(error ? 404 : 200, { 'content-type': types[path.extname(request.url)] || 'application/octet-stream' });
    response.end(error ? '' : data);
  });
});

async function main() {
  await new Promise((done) => server.listen(0, '127.0.0.1', done));
  const browser = await chromium.launch({ executablePath: process.env.CHROMIUM || '/usr/bin/chromium',
    args: ['--no-sandbox', '--disable-background-networking', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
      '--ignore-gpu-blocklist'] });
  try {
    const page = await browser.newPage();
    page.setDefaultTimeout(600000);
    page.on('pageerror', (error) => console.error(error.message));
    await page.goto(`http://127.0.0.1:${server.address().port}/pages/appearance.html#${process.env.MATERIALS || ''},${process.env.UP || 'y'}`);
    await page.waitForFunction(() => document.title === 'ready');
    const found = await page.evaluate(([names, n]) => window.view(names, n), [files.map((f) => `/data/${path.relative(folders.data, f)}`), +pixels]);
    found.forEach((f) => console.log(`${f.psnr.toFixed(2)} ${f.ssim.toFixed(4)} ${f.flip.toFixed(4)}`));
  } finally {
    await browser.close();
    server.close();
  }
}
main().catch((error) => { console.error(error.message); process.exit(1); });
