// Pictures of files as viewers show them, in headless Chromium:  node shot.cjs VIEWER FILE OUT.png [QUERY]
// VIEWER: three or cesium. QUERY: width=PIXELS, and what the page of the viewer takes.
// Served are FILE's folder, the pages beside this script, and node_modules of NODE_PATH. Prints the number of grey values of
// the pixels that are not background: a flat silhouette has few.
// A second line has the bounds at a time, if the page tells them.
const fs = require('fs'), http = require('http'), path = require('path');
const { chromium } = require('playwright-core');
const [viewer, file, out, query] = process.argv.slice(2);
const width = +new URLSearchParams(query).get('width') || 640;
const types = { '.html': 'text/html', '.js': 'text/javascript', '.json': 'application/json', '.css': 'text/css', '.wasm': 'application/wasm' };
const folders = { node_modules: process.env.NODE_PATH, pages: __dirname, data: path.dirname(path.resolve(file)) };

const server = http.createServer((request, response) => {
  const [, top, ...rest] = decodeURIComponent(new URL(request.url, 'http://x').pathname).split('/');
  fs.readFile(path.join(folders[top] || '/nowhere', ...rest), (error, data) => {
    response.writeHead(error ? 404 : 200, { 'content-type': types[path.extname(request.url.split('?')[0])] || 'application/octet-stream' });
    response.end(error ? '' : data);
  });
});

async function main() {
  await new Promise((done) => server.listen(0, '127.0.0.1', done));
  const browser = await chromium.launch({ executablePath: process.env.CHROMIUM || '/usr/bin/chromium',
    args: ['--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync',
      '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'] });
  try {
    const page = await browser.newPage({ viewport: { width, height: width * 3 / 4 } });
    page.setDefaultTimeout(240000);  // a busy machine without a GPU
    page.on('pageerror', (error) => console.error(`${viewer}: ${error.message}`));
    await page.goto(`http://127.0.0.1:${server.address().port}/pages/${viewer}.html?file=/data/${path.basename(file)}&${query || ''}`);
    await page.waitForFunction(() => document.title === 'ready', null);
    await page.screenshot({ path: out });
    const greys = await page.evaluate(() => {
      const canvas = document.querySelector('canvas'), copy = document.createElement('canvas');
      [copy.width, copy.height] = [canvas.width, canvas.height];
      const context = copy.getContext('2d');
      context.drawImage(canvas, 0, 0);
      const data = context.getImageData(0, 0, copy.width, copy.height).data, found = new Set();
      for (let i = 0; i < data.length; i += 4) {
        if (data[i] === 0x40 && data[i + 1] === 0x50 && data[i + 2] === 0x70) continue;
        found.add(Math.round((data[i] + data[i + 1] + data[i + 2]) / 3));
      }
      return found.size;
    });
    console.log(greys);
    const box = await page.evaluate(() => document.body.dataset.box);
    if (box) console.log(box);
  } finally {
    await browser.close();
    server.close();
  }
}
main().catch((error) => { console.error(error.message); process.exit(1); });
