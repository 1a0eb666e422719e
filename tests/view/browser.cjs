// What the tests of the page share in headless Chromium. CHROMIUM: the browser, else /usr/bin/chromium.
const path = require('path');
const { chromium } = require('playwright-core');
const served = require('./served.cjs');

Object.assign(exports, served);

exports.launch = () => chromium.launch({ executablePath: process.env.CHROMIUM || '/usr/bin/chromium',
  args: ['--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync',
    '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'] });

/// Opens the page, and waits until it shows the closing. Its errors go to `troubles`.
exports.open = async (context, link, troubles) => {
  const page = await context.newPage();
  page.setDefaultTimeout(60000);
  page.on('pageerror', (error) => troubles.push(error.message));
  page.on('console', (message) => { if (message.type() === 'error') troubles.push(message.text()); });
  await page.goto(link);
  await page.waitForFunction(() => window.bpview?.ready && window.bpview.generation > 0);
  return page;
};

exports.picture = async (page, folder, name) => {
  await served.drawn(page);
  await page.screenshot({ path: path.join(folder, `${name}.png`) });
};

/// Returns how many pixels in a box of the page `act` changes.
exports.changed = async (page, clip, act) => {
  const pictures = [];
  for (const step of [() => {}, act]) {
    await step();
    await served.drawn(page);
    pictures.push((await page.screenshot({ clip })).toString('base64'));
  }
  return page.evaluate(async (both) => {
    const [a, b] = await Promise.all(both.map(async (data) => {
      const bitmap = await createImageBitmap(new Blob([Uint8Array.from(atob(data), (c) => c.charCodeAt(0))], { type: 'image/png' }));
      const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
      context.drawImage(bitmap, 0, 0);
      return context.getImageData(0, 0, bitmap.width, bitmap.height).data;
    }));
    let count = 0;
    for (let i = 0; i < a.length; i += 4) count += Math.abs(a[i] - b[i]) + Math.abs(a[i + 1] - b[i + 1]) + Math.abs(a[i + 2] - b[i + 2]) > 12;
    return count;
  }, pictures);
};

/// Returns whether an element can be seen whole, without scrolling.
exports.inView = (page, selector) => page.evaluate((what) => {
  const element = document.querySelector(what), box = element.getBoundingClientRect(), middle = box.left + box.width / 2;
  return box.height > 0 && [[middle, box.top + 1], [middle, box.bottom - 1]].every(([x, y]) => element.contains(document.elementFromPoint(x, y)));
}, selector);

/// Moves the pointer there. Returns the point of the surface that the page tells.
exports.pointAt = async (page, x, y) => {
  await page.mouse.move(x, y);
  await served.drawn(page, 1);
  return (await page.textContent('#point')).split(/\s+/).map(Number);
};

/// Returns shares of the pixels in a box of the page, once they are drawn: of those that differ from the one at its first corner, and of red ones.
exports.colors = async (page, x, y, width, height) => {
  await served.drawn(page);
  const png = (await page.screenshot({ clip: { x, y, width, height } })).toString('base64');
  return page.evaluate(async (data) => {
    const bytes = Uint8Array.from(atob(data), (c) => c.charCodeAt(0));
    const bitmap = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
    const canvas = new OffscreenCanvas(bitmap.width, bitmap.height), context = canvas.getContext('2d');
    context.drawImage(bitmap, 0, 0);
    const pixels = context.getImageData(0, 0, bitmap.width, bitmap.height).data;
    let other = 0, red = 0;
    for (let i = 0; i < pixels.length; i += 4) {
      if (pixels[i] > 60 && pixels[i + 1] < 0.5 * pixels[i] && pixels[i + 2] < 0.6 * pixels[i]) red++;
      if (Math.abs(pixels[i] - pixels[0]) + Math.abs(pixels[i + 1] - pixels[1]) + Math.abs(pixels[i + 2] - pixels[2]) > 24) other++;
    }
    return { other: (4 * other) / pixels.length, red: (4 * red) / pixels.length };
  }, png);
};
