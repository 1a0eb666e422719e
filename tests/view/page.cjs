// A person at the page of bpview:  node page.cjs FOLDER SCENE [OPTIONS...]
// FOLDER holds the scene, and gets rules, proxy and pictures. Exit status 1 if something is wrong.
const fs = require('fs'), path = require('path');
const { execFileSync } = require('child_process');
const { Checks, end, launch, open: openPage, picture: takePicture, serve: start, sleep, state: stateOf, until: waitUntil } = require('./browser.cjs');
const [folder, scene, ...options] = process.argv.slice(2);
const checks = new Checks(), check = (...args) => checks.check(...args);
const serve = (...more) => start(folder, scene, ...options, ...more);

async function main() {
  let { child, link } = await serve();
  const browser = await launch();
  const context = await browser.newContext({ viewport: { width: 1280, height: 720 } });
  const troubles = [];
  const open = async (where) => {
    const begin = Date.now(), page = await openPage(context, where, troubles);
    console.log(`page ready after ${Date.now() - begin} ms`);
    return page;
  };
  const page = await open(link);
  check('the token leaves the address', !page.url().includes('#'), page.url());
  const state = (of = page) => stateOf(of);
  const until = (done, what, of = page) => waitUntil(of, done, what);
  const isReady = (s) => s.proxy.step === 'ready' && s.proxy.current;
  const picture = (name) => takePicture(page, folder, name);
  const stroke = async (points) => {
    await page.mouse.move(...points[0]);
    await page.mouse.down();
    for (const point of points.slice(1)) { await page.mouse.move(...point, { steps: 4 }); await sleep(40); }
    await page.mouse.up();
  };
  const middle = async () => { const box = await page.locator('#canvas').boundingBox(); return [box.x + box.width * 0.44, box.y + box.height / 2]; };  // the body
  const [x, y] = await middle();

  let s = await until(isReady, 'the first proxy');
  check('the first proxy is proven', s.proxy.verdict.answer === 'proven', s.proxy);
  await page.waitForFunction(() => document.getElementById('badge').textContent === 'proven');
  await picture('closing');

  // Brushes, with the latency from the last event of the pointer to the surface on the screen.
  await page.keyboard.press('b');
  const before = s.design.revision, times = [];
  for (let i = 0; i < 5; ++i) {
    const shown = await page.evaluate(() => window.bpview.revision);
    await page.mouse.move(x - 8 + 4 * i, y - 20 + 15 * i);
    await page.mouse.down();
    const begin = await page.evaluate(() => performance.now());
    await page.mouse.up();
    const end = await page.evaluate((old) => new Promise((done) => {
      const look = () => (window.bpview.revision > old ? requestAnimationFrame(() => done(performance.now())) : setTimeout(look, 2));
      look();
    }), shown);
    times.push(Math.round(end - begin));
  }
  console.log(`stroke to frame: ${times.join(' ')} ms`);
  await stroke([[x - 20, y - 120], [x, y - 100], [x, y - 60], [x, y], [x - 4, y + 40]]);
  s = await until((q) => q.design.rules.length === 6, 'six strokes');
  check('a stroke has many points', Array.isArray(s.design.rules[5].at[0]), s.design.rules[5]);
  check('a stroke is one step', s.design.revision > before + 5);
  await page.keyboard.press('c');
  await page.fill('#target', '5%');
  await page.keyboard.press('Enter');
  await stroke([[x - 2, y + 60], [x, y + 80]]);
  s = await until((q) => q.design.rules.length === 7, 'a coarser stroke');
  check('a coarser stroke has the scale that was asked for', s.design.rules[6].mode === 'increase' && s.design.rules[6].scale === '5%', s.design.rules[6]);
  const turned = await page.evaluate(() => window.bpview.frames());
  await stroke([[40, 600], [80, 560]]);  // beside the surface the view turns
  check('beside the surface nothing is brushed', (await state()).design.rules.length === 7);
  check('the view turned', (await page.evaluate(() => window.bpview.frames())) > turned);
  await page.keyboard.press('f');

  // Undo and redo by keys and buttons.
  await page.locator('#view').focus();
  const full = await state();
  for (let i = 0; i < 3; ++i) await page.keyboard.press('Control+z');
  s = await until((q) => q.design.rules.length === 4, 'three undone');
  await page.keyboard.press('Control+Shift+Z');
  await page.click('#redo');
  await page.keyboard.press('Control+y');
  s = await until((q) => q.design.rules.length === 7 && q.closing.shown === q.design.revision, 'three redone');
  s = await until((q) => q.closing.voxels === full.closing.voxels || q.closing.shown > full.closing.shown, 'the closing again');
  await page.locator('#rules button').last().click();  // the first rule
  s = await until((q) => q.design.rules.length === 6, 'a rule removed');

  // A part by its name: the closing changes, and a name that is not there is told.
  const name = await page.locator('#part-names option').first().getAttribute('value'), unnamed = (await until((q) => q.closing.shown === q.design.revision, 'the closing')).closing.voxels;
  await page.fill('#part', name);
  await page.click('#part-finer');
  s = await until((q) => q.design.rules.length === 7 && q.closing.shown === q.design.revision, 'a rule by name');
  check('the part has the scale of the brush', s.design.rules[6].node === name && s.design.rules[6].mode === 'decrease' && s.design.rules[6].scale === '5%', s.design.rules[6]);
  await page.fill('#part', 'no such part');
  await page.click('#part-coarser');
  await page.waitForSelector('#message:not([hidden])');
  check('a missing part is told', (await page.textContent('#message')).includes('no such part'), await page.textContent('#message'));
  await page.locator('#view').focus();
  await page.keyboard.press('Control+z');
  s = await until((q) => q.design.rules.length === 6 && q.closing.shown === q.design.revision, 'the rule by name undone');
  check('without the rule the closing is as before', s.closing.voxels === unnamed, s.closing.voxels, unnamed);

  // Sliders and keys.
  await page.keyboard.press('[');
  await page.locator('#base-slide').focus();
  await page.keyboard.press('ArrowRight');
  s = await until((q) => q.design.base !== full.design.base, 'another base');
  await page.fill('#faces', '700');
  await page.keyboard.press('Enter');
  s = await until((q) => q.faces === 700, 'other faces');
  for (const key of ['1', '3']) await page.keyboard.press(key);
  check('keys show layers', await page.getAttribute('[data-layer=proxy]', 'aria-pressed') === 'true');
  await page.click('#live');
  await until((q) => !q.live && !['meshing', 'checking'].includes(q.proxy.step), 'the proxy at work');
  await page.waitForFunction(() => document.getElementById('mesh').textContent === 'Mesh');
  await page.click('#mesh');
  s = await until(isReady, 'a proxy');
  check('the proxy is proven', s.proxy.verdict.answer === 'proven', s.proxy);
  await page.waitForFunction(() => document.getElementById('badge').textContent === 'proven');
  await page.waitForFunction((n) => window.bpview.proxy === n, s.proxy.number);
  await picture('all');
  await page.keyboard.press('2');
  await sleep(300);
  await picture('proxy');

  // What is saved is what the command line makes.
  await page.click('#save-rules');
  await page.click('#save-proxy');
  await page.waitForFunction(() => document.getElementById('save-rules').textContent === 'Rules saved');
  await until(() => fs.existsSync(path.join(folder, 'proxy.glb')), 'the saved proxy');
  const mine = fs.readFileSync(path.join(folder, 'proxy.glb')), command = await page.textContent('#command');
  execFileSync('bash', ['-c', `set -o pipefail; ${command} --overwrite`], { cwd: folder, stdio: ['ignore', 'ignore', 'ignore'] });
  check('the proxy has the bytes of the command line', fs.readFileSync(path.join(folder, 'proxy.glb')).equals(mine), command);

  // A second tab sees the same; a reload needs no link.
  const other = await open(page.url());
  await other.keyboard.press('Control+z');
  await until((q) => q.design.can_redo, 'an undo in another tab', page);
  await other.close();
  await page.reload();
  await page.waitForFunction(() => window.bpview?.ready && window.bpview.generation > 0);
  check('a reload keeps the design', (await state()).design.rules.length === 6);
  check('nothing went wrong on the page', troubles.every((text) => text.includes('400')), troubles);  // the part that is not there

  // A stranger, and a server that is gone.
  const stranger = await (await browser.newContext()).newPage();
  await stranger.goto(page.url());
  await stranger.waitForSelector('#message:not([hidden])');
  check('without the link the page says so', (await stranger.textContent('#message')).includes('link'));
  await end(child);
  await page.waitForSelector('#message:not([hidden])');
  check('the page says that the server is gone', (await page.textContent('#message')).includes('does not answer'));

  // Dark, from the saved rules.
  ({ child, link } = await serve('--rules', 'rules.json'));
  await page.emulateMedia({ colorScheme: 'dark' });
  await page.goto(link);
  await page.waitForFunction(() => window.bpview?.ready && window.bpview.generation > 0);
  check('a design goes on from its rules', (await state()).design.rules.length === 6);
  await until(isReady, 'a proxy of the saved rules');
  await sleep(500);
  await picture('dark');
  await browser.close();
  await end(child);
  process.exit(checks.failed > 0 ? 1 : 0);
}
main().catch((error) => { console.error(error); process.exit(1); });
