// Makes the pictures of docs/guides/brush.md and docs/guides/look.md in headless Chromium, as their text goes:
//   node docs/view_gallery.cjs FOLDER
// FOLDER is made anew, and gets the scenes, what the suite makes of them, and pictures for docs/images. The tools are on PATH; playwright-core
// is found as tests/view/page.sh installs it (NODE_PATH).
const fs = require('fs'), path = require('path');
const { execFileSync } = require('child_process');
const { end, launch, open, serve, sleep, state, until } = require('../tests/view/browser.cjs');
const folder = path.resolve(process.argv[2]);
const shell = (line) => execFileSync('bash', ['-c', `set -eo pipefail; ${line}`], { cwd: folder, stdio: ['ignore', 'ignore', 'inherit'] });

/// A person at the page.
class Person {
  constructor(page) { this.page = page; }
  key(...keys) { return keys.reduce((before, key) => before.then(() => this.page.keyboard.press(key)), Promise.resolve()); }
  async fill(field, value) {
    await this.page.fill(field, value);
    await this.key('Enter');
  }
  /// A stroke through points of the scene, where they are on the page.
  async stroke(points) {
    const { mouse } = this.page;
    const at = async (point) => this.page.evaluate((p) => window.bpview.pixel(p), point);
    await mouse.move(...(await at(points[0])));
    await mouse.down();
    for (const point of points.slice(1)) { await mouse.move(...(await at(point)), { steps: 6 }); await sleep(60); }
    await mouse.up();
  }
  async turn(steps) {
    await this.page.locator('#view').focus();
    for (let i = 0; i < Math.abs(steps); ++i) await this.key(steps > 0 ? 'ArrowRight' : 'ArrowLeft');
  }
  closed() { return until(this.page, (s) => s.closing.shown === s.design.revision && !s.closing.error, 'the closing'); }
  proven() { return until(this.page, (s) => s.proxy.step === 'ready' && s.proxy.current && s.proxy.verdict.answer === 'proven', 'a proven proxy'); }
  async picture(name) {
    const s = await state(this.page);
    await this.page.waitForFunction((g) => window.bpview.generation === g, s.closing.generation);
    await sleep(500);
    fs.mkdirSync(path.dirname(path.join(folder, name)), { recursive: true });
    await this.page.screenshot({ path: path.join(folder, `${name}.png`), scale: 'css' });
  }
}

async function with_page(browser, size, options, act) {
  const { child, link } = await serve(folder, ...options);
  const troubles = [], context = await browser.newContext({ viewport: size, deviceScaleFactor: 2 });  // pictures are smooth though the page does not smooth edges here
  const page = await open(context, link, troubles);
  await act(new Person(page));
  await context.close();
  await end(child);
  if (troubles.length > 0) throw new Error(troubles.join('\n'));
}

async function head(person) {
  await person.fill('#base', '4%');
  await person.turn(-6);
  await person.closed();
  await person.proven();
  await person.picture('brush/one');
  await person.key('b');
  await person.stroke([[0, 1.95, 0.3], [0, 1.8, 0.2], [0, 1.62, 0.2], [0, 1.5, 0.2]]);
  for (const y of [2.05, 2.15, 2.28]) await person.stroke([[-0.16, y, 0.1], [0, y, 0.1], [0.16, y, 0.1]]);
  await person.closed();
  await person.proven();
  await person.picture('brush/head');
  await person.key('v', '3', '2');
  await person.page.waitForFunction((n) => window.bpview.proxy === n, (await state(person.page)).proxy.number);
  await person.picture('brush/proxy');
  await person.key('3', '2');
  await person.page.click('#cubes summary');
  const chest = await person.page.evaluate(() => window.bpview.pixel([0, 1.25, 0.2]));
  await person.page.mouse.move(chest[0] - 3, chest[1]);
  await person.page.mouse.move(...chest);
  await person.page.waitForFunction(() => document.getElementById('point').textContent !== '');
  await person.page.locator('#view').focus();
  await person.key('o');
  await until(person.page, (s) => s.design.orientation?.length === 1, 'a frame');
  await person.fill('#frame-rx', '20');
  await until(person.page, (s) => s.design.orientation[0].frame[1] !== 0, 'a turned frame');
  await person.closed();
  await person.picture('brush/frame');
}

/// The door is in the wall at z = 0, and the page begins with a view from z > 0.
async function door(person) {
  await person.fill('#base', '4.5%');
  await person.turn(28);
  await person.closed();
  await person.key('b');
  await person.stroke([[5.8, 0.4, 0], [5.8, 1.0, 0], [5.8, 1.7, 0]]);
  await person.closed();
  await person.proven();
  await person.picture('brush/door');
}

async function look(person) {
  await person.page.click('#prove-all');
  await until(person.page, (s) => s.layers.every((layer) => layer.step === 'done'), 'all answers');
  await person.page.locator('#view').focus();
  await person.key('2', '4');  // the cage is hidden
  await person.page.locator('#files input[type=checkbox]').nth(3).check();
  await person.page.locator('#files input[type=range]').nth(3).fill('100');
  await person.page.locator('#view').focus();
  await person.turn(-3);
  await person.key('d');
  await person.page.waitForFunction(() => !document.getElementById('far').hidden);
  await person.picture('look/distances');
  await person.key('d');
  await person.page.locator('#files input[type=checkbox]').nth(3).uncheck();
  await person.page.locator('#files input[type=checkbox]').first().check();
  await person.page.locator('#files input[type=range]').first().fill('100');
  await person.page.locator('#view').focus();
  await person.key('1', 'x');
  await person.picture('look/cut');
  await person.key('x', 'x', 'x', 'x', '1');
  await person.page.click('[data-half=design]');
  for (const faces of ['300', '500', '1500', '3000']) {
    await person.fill('#faces', faces);
    await person.proven();
  }
  await person.page.click('[data-half=look]');
  await person.page.locator('#plot svg').first().locator('circle').nth(2).click();
  await sleep(500);
  await person.picture('look/plot');
}

async function main() {
  fs.rmSync(folder, { recursive: true, force: true });
  fs.mkdirSync(folder, { recursive: true });
  execFileSync(path.join(__dirname, '../samples/scenes.py'), ['.'], { cwd: folder, stdio: 'ignore' });
  const browser = await launch();
  await with_page(browser, { width: 1280, height: 800 }, ['figure.obj', '--faces', '800'], head);
  await with_page(browser, { width: 1280, height: 800 }, ['house.obj', '--faces', '1500'], door);
  shell('bplod figure.obj --faces 2000,500,100 -o lod -q && bplod figure.obj --profile cage -o cage -q');
  await with_page(browser, { width: 1280, height: 720 }, ['figure.obj', '--show', 'cage/figure_cage.obj', '--show', 'lod'], look);
  await browser.close();
}
main().catch((error) => { console.error(error); process.exit(1); });
