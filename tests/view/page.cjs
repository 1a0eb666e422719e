// A person at the page of bpview:  node page.cjs FOLDER SCENE [OPTIONS...]
// FOLDER holds the scene, and gets rules, proxy and pictures. Exit status 1 if something is wrong.
const fs = require('fs'), path = require('path');
const { execFileSync } = require('child_process');
const { changed, Checks, drawn, end, inView, launch, message, open: openPage, picture: takePicture, pointAt, serve: start, state: stateOf, until: waitUntil } = require('./browser.cjs');
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
    for (const point of points.slice(1)) { await page.mouse.move(...point, { steps: 4 }); await drawn(page, 1); }
    await page.mouse.up();
  };
  const middle = async () => { const box = await page.locator('#canvas').boundingBox(); return [box.x + box.width * 0.44, box.y + box.height / 2]; };  // the body
  const [x, y] = await middle();

  let s = await until(isReady, 'the first proxy');
  check('the first proxy is proven', s.proxy.verdict.answer === 'proven', s.proxy);
  await page.waitForFunction(() => document.getElementById('badge').textContent === 'proven');
  for (const half of ['look', 'design']) {
    await page.click(`[data-half=${half}]`);
    check('the verdict is in view', await inView(page, '#proof'), half);
  }
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
  await page.waitForFunction((n) => window.bpview.frames() > n, turned);
  check('beside the surface nothing is brushed', (await until(() => true, 'no edit')).design.rules.length === 7);
  await page.keyboard.press('f');

  // Undo and redo by keys and buttons.
  await page.locator('#view').focus();
  const full = await until((q) => q.closing.shown === q.design.revision, 'the closing of all strokes');
  for (let i = 0; i < 3; ++i) await page.keyboard.press('Control+z');
  s = await until((q) => q.design.rules.length === 4, 'three undone');
  await page.keyboard.press('Control+Shift+Z');
  await page.click('#redo');
  await page.keyboard.press('Control+y');
  s = await until((q) => q.design.rules.length === 7 && q.closing.shown === q.design.revision, 'three redone');
  check('redone strokes have their closing again', s.closing.voxels === full.closing.voxels, s.closing, full.closing);
  await page.locator('#rules button').last().click();  // the first rule
  s = await until((q) => q.design.rules.length === 6, 'a rule removed');

  // A part by its name: the closing changes, and a name that is not there is told.
  const name = await page.locator('#part-names option').first().getAttribute('value'), unnamed = (await until((q) => q.closing.shown === q.design.revision, 'the closing')).closing.voxels;
  await page.fill('#part', name);
  await page.click('#part-finer');
  s = await until((q) => q.design.rules.length === 7 && q.closing.shown === q.design.revision, 'a rule by name');
  check('the part has the scale of the brush', s.design.rules[6].node === name && s.design.rules[6].mode === 'decrease' && s.design.rules[6].scale === '5%', s.design.rules[6]);
  const names = await page.locator('#part-names option').evaluateAll((all) => all.map((o) => o.value));
  const nameAt = async (px, py) => {
    await page.fill('#part', '');
    await page.locator('#view').focus();
    await page.keyboard.press('p');
    await page.mouse.click(px, py);
    await page.waitForFunction(() => document.getElementById('part').value !== '');
    return page.inputValue('#part');
  };
  check('a click on the body tells its part', await nameAt(x, y) === 'skin', names);
  await page.fill('#part', 'no such part');
  await page.click('#part-coarser');
  await message(page, 'no such part');
  await page.locator('#view').focus();
  await page.keyboard.press('Control+z');
  s = await until((q) => q.design.rules.length === 6 && q.closing.shown === q.design.revision, 'the rule by name undone');
  check('without the rule the closing is as before', s.closing.voxels === unnamed, s.closing.voxels, unnamed);

  // The mirror plane: a stroke and its mirror image are two rules and one step.
  await page.keyboard.press('y');
  check('Y chooses a plane through the middle', await page.getAttribute('[data-mirror=x]', 'aria-pressed') === 'true' && Math.abs(Number(await page.inputValue('#mirror-at')) - s.scene.middle[0]) < 1e-3, await page.inputValue('#mirror-at'));
  await page.fill('#mirror-at', '0.05');
  await page.keyboard.press('Enter');
  await page.keyboard.press('b');
  await stroke([[x - 10, y - 60], [x - 14, y - 30], [x - 16, y]]);
  s = await until((q) => q.design.rules.length === 8 && q.closing.shown === q.design.revision, 'a stroke and its mirror image');
  const [one, image] = s.design.rules.slice(6), ends = (rule) => [rule.at[0], rule.at.at(-1)];
  check('the image lies across the plane', ends(one).every((p, i) => Math.abs(p[0] + ends(image)[i][0] - 0.1) < 1e-9 && p[1] === ends(image)[i][1] && p[2] === ends(image)[i][2]), one, image);
  await picture('mirror');
  await page.keyboard.press('Control+z');
  s = await until((q) => q.design.rules.length === 6, 'both undone');
  await page.keyboard.press('Control+Shift+Z');
  s = await until((q) => q.design.rules.length === 8, 'both done again');
  for (let i = 0; i < 3; ++i) await page.keyboard.press('y');
  check('the last one is no plane', await page.getAttribute('[data-mirror=off]', 'aria-pressed') === 'true');
  await page.keyboard.press('v');

  // Frames that turn the cubes: by key, by numbers and by the gizmo; undone and removed.
  const upright = (await until((q) => q.closing.shown === q.design.revision, 'the closing')).closing.voxels;
  await page.waitForFunction((n) => window.bpview.revision >= n, s.design.revision);  // the surface under the pointer
  const place = await pointAt(page, x, y - 20);
  await page.keyboard.press('o');
  s = await until((q) => q.design.orientation?.length === 1, 'a frame');
  check('O places a frame under the pointer', s.design.orientation[0].at.every((q, i) => Math.abs(q - place[i]) < 0.02), s.design.orientation, place);
  await page.fill('#frame-rx', '30');
  await page.keyboard.press('Enter');
  s = await until((q) => q.design.orientation[0].frame[1] > 0.2 && q.closing.shown === q.design.revision, 'a turned frame');
  check('the frame is turned by 30 degrees about x', Math.abs(s.design.orientation[0].frame[0] - 0.9659) < 1e-3 && Math.abs(s.design.orientation[0].frame[1] - 0.2588) < 1e-3, s.design.orientation);
  check('turned cubes close otherwise', s.closing.voxels !== upright, s.closing.voxels, upright);
  await picture('frame');
  const turnedBy = JSON.stringify(s.design.orientation), revision = s.design.revision;
  await page.click('[data-gizmo=translate]');
  const gizmo = await page.evaluate(() => window.bpview.frame());  // where the frame is on the screen
  let moved = false;
  for (const [dx, dy] of [[0, -40], [40, 0], [-40, 0], [0, 40], [30, 15], [-30, 15]]) {  // an arrow of the gizmo is somewhere there
    await page.mouse.move(gizmo[0] + dx, gizmo[1] + dy, { steps: 3 });
    await page.mouse.down();
    await page.mouse.move(gizmo[0] + dx * 1.6, gizmo[1] + dy * 1.6, { steps: 5 });
    await page.mouse.up();
    s = await until(() => true, 'the answer to the drag');
    moved = JSON.stringify(s.design.orientation[0].at) !== JSON.stringify(JSON.parse(turnedBy)[0].at);
    if (moved) break;
  }
  check('the gizmo moves the frame, and turns it not', moved && JSON.stringify(s.design.orientation[0].frame) === JSON.stringify(JSON.parse(turnedBy)[0].frame), s.design.orientation);
  check('a drag was several requests', s.design.revision > revision);
  await page.locator('#view').focus();
  await page.keyboard.press('Control+z');
  s = await until((q) => JSON.stringify(q.design.orientation) === turnedBy, 'the drag undone in one step');
  await page.click('[data-cubes=auto]');
  await until((q) => q.design.orientation === 'auto' && q.closing.shown === q.design.revision && !q.closing.error, 'cubes as the scene stands');
  await page.keyboard.press('Control+z');
  await page.keyboard.press('o');  // at once: the frame comes back, and another one beside it
  await until((q) => q.design.orientation?.length === 2, 'a second frame');
  await page.locator('#frames li').first().locator('button').last().click();
  s = await until((q) => q.design.orientation?.length === 1 && q.design.orientation[0].frame[1] === 0, 'the first frame removed');
  await page.locator('#view').focus();
  await page.keyboard.press('Control+z');
  await page.keyboard.press('Control+z');
  s = await until((q) => JSON.stringify(q.design.orientation) === turnedBy && q.closing.shown === q.design.revision, 'one frame, turned');  // it is saved below
  await page.keyboard.press('f');

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
  await page.click('#mesh');
  s = await until(isReady, 'a proxy');
  check('the proxy is proven', s.proxy.verdict.answer === 'proven', s.proxy);
  await page.waitForFunction(() => document.getElementById('badge').textContent === 'proven');
  await page.waitForFunction((n) => window.bpview.proxy === n, s.proxy.number);
  await picture('all');
  // An opaque proxy hides the scene, from near and from far, but for some pixels of its outline.
  await page.keyboard.press('2');
  await page.locator('[data-opacity=proxy]').fill('100');
  await page.locator('#view').focus();
  await picture('proxy');
  for (const [key, times] of [['f', 1], ['-', 10], ['+', 16]]) {
    for (let i = 0; i < times; ++i) await page.keyboard.press(key);
    const through = await changed(page, { x: 0, y: 70, width: 640, height: 570 }, () => page.keyboard.press('1'));
    check('the scene does not show through', through < 200, key, through);
    await page.keyboard.press('1');
  }

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
  s = await state();
  check('a reload keeps the design', s.design.rules.length === 8 && JSON.stringify(s.design.orientation) === turnedBy, s.design);
  check('a reload shows the frame', await page.inputValue('#frame-rx') === '30' && await page.isVisible('#frame-rx'), await page.inputValue('#frame-rx'));
  check('nothing went wrong on the page', troubles.every((text) => text.includes('400')), troubles);  // the part that is not there

  // A stranger, and a server that is gone: what was not saved can be downloaded.
  const stranger = await (await browser.newContext()).newPage();
  await stranger.goto(page.url());
  await message(stranger, 'link');
  s = await until((q) => !q.design.saved, 'the design that was undone after it was saved');
  const rules = await page.evaluate(() => fetch('/api/rules').then((r) => r.text()));
  await page.waitForFunction((n) => window.bpview.kept() === n, s.design.revision);
  await end(child);
  await message(page, 'does not answer');
  const [download] = await Promise.all([page.waitForEvent('download'), page.click('#kept')]);
  check('the page has kept the rules', download.suggestedFilename() === 'rules.json' && fs.readFileSync(await download.path(), 'utf8') === rules, rules);
  await picture('gone');

  // Dark, from the saved rules.
  ({ child, link } = await serve('--rules', 'rules.json'));
  await page.emulateMedia({ colorScheme: 'dark' });
  await page.goto(link);
  await page.waitForFunction(() => window.bpview?.ready && window.bpview.generation > 0);
  check('a design goes on from its rules', (await state()).design.rules.length === 8);
  s = await until(isReady, 'a proxy of the saved rules');
  await page.waitForFunction((n) => window.bpview.proxy === n, s.proxy.number);
  await picture('dark');
  await browser.close();
  await end(child);
  process.exit(checks.failed > 0 ? 1 : 0);
}
main().catch((error) => { console.error(error); process.exit(1); });
