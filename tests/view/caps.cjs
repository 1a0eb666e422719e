// Layers that are cut: closed ones are filled, the innermost is seen, and points of sections are picked; and their opacity.   node caps.cjs FOLDER
// FOLDER gets scenes and pictures. Exit status 1 if something is wrong.
const fs = require('fs'), path = require('path');
const { Checks, drawn, end, launch, open, picture, pointAt, serve } = require('./browser.cjs');
const [folder] = process.argv.slice(2);
const checks = new Checks(), check = (...args) => checks.check(...args);

/// A box as OBJ, after `first` other vertices. Inverted, it bounds a cavity; open, it has no top.
function box(low, high, first, { inverted = false, open = false } = {}) {
  const quads = [[3, 7, 8, 4], [1, 5, 7, 3], [2, 4, 8, 6], [1, 3, 4, 2], [5, 6, 8, 7], [1, 2, 6, 5]].slice(open ? 1 : 0);
  const points = Array.from({ length: 8 }, (_, i) => `v ${[0, 1, 2].map((k) => (i >> k & 1 ? high : low)).join(' ')}`);
  return [...points, ...quads.map((q) => `f ${(inverted ? [...q].reverse() : q).map((v) => v + first).join(' ')}`)].join('\n') + '\n';
}

async function main() {
  fs.writeFileSync(path.join(folder, 'hollow.obj'), box(0, 10, 0) + box(3, 7, 8, { inverted: true }));
  fs.writeFileSync(path.join(folder, 'around.obj'), box(-2, 12, 0));
  fs.writeFileSync(path.join(folder, 'open.obj'), box(0, 10, 0, { open: true }));
  const { child, link } = await serve(folder, 'hollow.obj', '--resolution', '50', '--show', 'around.obj', '--show', 'open.obj');
  const browser = await launch(), troubles = [];
  const page = await open(await browser.newContext({ viewport: { width: 1280, height: 720 } }), link, troubles);
  /// The mean colour in a square around a point of the scene, and its darkest pixel over its brightest: sections are hatched.
  const at = async (...point) => {
    await drawn(page);
    const [x, y] = await page.evaluate((p) => window.bpview.pixel(p), point);
    const png = (await page.screenshot({ clip: { x: x - 7, y: y - 7, width: 15, height: 15 } })).toString('base64');
    return page.evaluate(async (data) => {
      const bitmap = await createImageBitmap(new Blob([Uint8Array.from(atob(data), (c) => c.charCodeAt(0))], { type: 'image/png' }));
      const context = new OffscreenCanvas(15, 15).getContext('2d');
      context.drawImage(bitmap, 0, 0);
      const pixels = context.getImageData(0, 0, 15, 15).data, sum = [0, 0, 0], light = [];
      for (let i = 0; i < pixels.length; i += 4) { for (let k = 0; k < 3; ++k) sum[k] += pixels[i + k] / 225; light.push(pixels[i] + pixels[i + 1] + pixels[i + 2]); }
      const [r, g, b] = sum.map(Math.round), contrast = Math.min(...light) / Math.max(...light), hatched = contrast < 0.85;
      return { r, g, b, contrast, hatched, red: r > 60 && g < 0.5 * r && b < 0.6 * r };
    }, png);
  };
  const picked = async (...point) => {
    const [x, y] = await page.evaluate((p) => window.bpview.pixel(p), point);
    return pointAt(page, x, y);
  };
  const near = (p, q) => p.length === 3 && p.every((value, i) => Math.abs(value - q[i]) < 0.05);
  const wall = [1.5, 5, 5], cavity = [5, 5, 5], beside = [-1, 5, 5];
  const rows = page.locator('#files li'), shown = (i) => rows.nth(i).locator('input[type=checkbox]');
  await page.waitForFunction(() => window.bpview.files() === 1);
  await shown(0).uncheck();
  await page.locator('#view').focus();
  for (const key of ['1', '2']) await page.keyboard.press(key);  // the scene alone
  await page.click('[data-cut=z]');

  let p = await at(...wall);
  check('a closed scene is filled where it is cut', p.hatched && !p.red && p.b > p.r, p);
  p = await at(...cavity);
  check('its cavity is not', !p.hatched && !p.red, p);
  let q = await picked(...wall);
  check('a point of the section is picked', near(q, wall), q);
  q = await picked(...cavity);
  check('through the cavity its far wall is picked', q[2] < 4.9, q);
  await picture(page, folder, 'scene');
  await page.keyboard.press('k');
  p = await at(...wall);
  check('hollow, its inside is red', p.red && !p.hatched, p);
  q = await picked(...wall);
  check('hollow, a point of the inside is picked', q[2] < 4.9, q);
  await page.keyboard.press('k');

  await page.keyboard.press('2');  // the closing has no cavity
  [p, q] = [await at(...wall), await at(...cavity)];
  check('the section of the scene is seen in that of the closing', p.hatched && p.b > p.r && q.hatched && q.r > q.b, p, q);
  await shown(0).check();
  await rows.nth(0).locator('input[type=range]').fill('100');
  const all = [await at(...wall), await at(...cavity), await at(...beside)];
  check('three layers show their sections', all.every((c) => c.hatched && !c.red) && all[0].b > all[0].r && all[1].r > all[1].b && all[2].r > 1.3 * all[2].b, all);
  q = await picked(...beside);
  check('a point of the outer section is picked', near(q, beside), q);
  await picture(page, folder, 'three');
  await rows.nth(0).locator('input[type=range]').fill('70');
  p = await at(...beside);
  check('a transparent layer has a transparent section, whose hatching is weaker', p.contrast < 0.9 && p.contrast > all[2].contrast && p.r > p.b && p.b > all[2].b + 10, p, all[2]);
  await picture(page, folder, 'transparent');

  await shown(0).uncheck();
  await page.locator('#view').focus();
  for (const key of ['1', '2']) await page.keyboard.press(key);
  await shown(1).check();
  await page.waitForFunction(() => window.bpview.files() === 2);
  await rows.nth(1).locator('input[type=range]').fill('100');
  p = await at(...wall);
  check('an open file is not filled', p.red && !p.hatched, p);
  await shown(1).uncheck();

  // Opacity is one thing for all layers: a layer that is alone is opaque, and beside others it shows what lies inside.
  await page.click('[data-cut=off]');
  await page.locator('#view').focus();
  const front = [5, 5, 10], bluer = [], opacity = (layer, value) => page.locator(`[data-opacity=${layer}]`).fill(String(value));
  await page.keyboard.press('2');
  await opacity('closing', 5);
  const alone = await at(...front);
  await opacity('closing', 100);
  p = await at(...front);
  check('a layer that is alone is opaque', p.r === alone.r && p.b === alone.b, p, alone);
  await page.keyboard.press('1');
  for (const value of [100, 50, 5]) {
    await opacity('closing', value);
    p = await at(...front);
    bluer.push(p.b - p.r);
  }
  check('beside the scene its opacity counts', bluer[0] < bluer[1] - 3 && bluer[1] < bluer[2] - 3, bluer);
  check('the slider of a hidden layer is off', await page.isDisabled('[data-opacity=proxy]'));
  check('nothing went wrong on the page', troubles.length === 0, troubles);
  await browser.close();
  await end(child);
  process.exit(checks.failed > 0 ? 1 : 0);
}
main().catch((error) => { console.error(error); process.exit(1); });
