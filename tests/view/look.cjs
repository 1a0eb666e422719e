// A person who looks at what the suite made of a scene:  node look.cjs FOLDER SCENE
// FOLDER holds the scene, and gets the suite's files and pictures. Exit status 1 if something is wrong.
const fs = require('fs'), path = require('path');
const { execFileSync } = require('child_process');
const { changed, Checks, colors, end, inView, launch, message, open, picture, pointAt, serve, state, until } = require('./browser.cjs');
const [folder, scene] = process.argv.slice(2);
const checks = new Checks(), check = (...args) => checks.check(...args);
const shell = (line) => execFileSync('bash', ['-c', `set -eo pipefail; ${line}`], { cwd: folder, stdio: ['ignore', 'ignore', 'inherit'] });

/// What is shown: levels in a folder, a tileset, hulls, a cage, a proxy that does not enclose the scene, and voxels.
function build() {
  shell(`bplod ${scene} --faces 800,200 -o lod -q`);
  shell(`bplod ${scene} --profile 3dtiles --faces 1000,300 --resolution 128 --tile 64 -o tiles -q`);
  shell(`bplod ${scene} --profile collision --faces 200 -o body -q`);
  shell(`bplod ${scene} --profile cage --faces 400 -o cage -q`);
  shell(`bpvox ${scene} --resolution 128 | bpclose -s 3% | tee closed.bpv | bpmesh --faces 300 --mode fit -o fit.ply`);
}

async function files(page) {
  const rows = page.locator('#files li'), row = (name) => rows.filter({ hasText: name });
  let s = await state(page);
  const names = s.layers.map((layer) => layer.name);
  check('all files are listed', ['lod/figure.glb', 'lod/figure_LOD1.glb', 'tiles', 'body/figure_unreal.glb', 'figure_cage.obj', 'fit.ply', 'closed.bpv'].every((name) => names.includes(name)), names);
  check('as many rows as files', await rows.count() === names.length);
  await page.waitForFunction(() => window.bpview.files() === 1);
  check('the first file is shown', await rows.first().locator('input[type=checkbox]').isChecked());
  // Each file is shown alone: pixels tell.
  await page.locator('#view').focus();
  for (const key of ['2', '4']) await page.keyboard.press(key);
  const empty = await colors(page, 200, 80, 500, 560);
  check('nothing is shown', empty.other < 0.001, empty);
  for (let i = 0, loaded = 1; i < names.length; ++i) {
    const box = rows.nth(i).locator('input[type=checkbox]');
    await box.check();
    if (i > 0) await page.waitForFunction((n) => window.bpview.files() === n, ++loaded);
    const seen = await colors(page, 200, 80, 500, 560);
    check('a file is seen', seen.other > 0.1, names[i], seen.other);
    check('its faces are counted', /^[\d,]+$/.test(await rows.nth(i).locator('.count').textContent()), names[i]);
    await box.uncheck();
  }
  const coarse = row('figure.glb').first();
  const fine = Number((await coarse.locator('.count').textContent()).replace(',', ''));
  await coarse.locator('select').selectOption('1');
  await page.waitForFunction((n) => document.querySelector('#files .count').textContent !== n && document.querySelector('#files .count').textContent !== '…', fine.toLocaleString('en'));
  check('a coarser level has fewer faces', Number((await coarse.locator('.count').textContent()).replace(',', '')) < fine);
  // Answers of bpcheck.
  for (const name of ['lod/figure.glb', 'tiles', 'body/figure_unreal.glb', 'figure_cage.obj', 'fit.ply']) await row(name).locator('button').click();
  s = await until(page, (q) => q.layers.filter((layer) => layer.step === 'done').length === 5, 'five answers');
  for (const layer of s.layers.filter((l) => l.step === 'done')) check('what a file claims is proven', layer.verdict.answer === 'proven', layer);
  check('voxels are not asked about', !(await row('closed.bpv').locator('button').isVisible()));
  check('the hulls claim to be convex parts', s.layers.find((l) => l.name === 'body/figure_unreal.glb').contract === 'convex parts');
  await page.waitForFunction(() => [...document.querySelectorAll('#files .badge')].filter((b) => b.textContent === 'proven').length === 5);
  check('a file can be proven again', await row('fit.ply').locator('button').isVisible());
  await picture(page, folder, 'files');
  await rows.first().locator('input[type=checkbox]').uncheck();
  return names;
}

/// The cut plane by keys: half of the closing goes, it is filled or its inside is red, and a point that was cut away is not picked.
async function cutting(page) {
  const seen = () => colors(page, 200, 80, 500, 560);
  await page.locator('#view').focus();
  await page.keyboard.press('2');
  const whole = await seen();
  check('a whole closing shows no inside', whole.red < 0.001, whole);
  await page.keyboard.press('x');
  const half = await seen();
  check('a cut closing is smaller, and is filled', half.red < 0.001 && half.other < 0.9 * whole.other, whole, half);
  check('the plane tells its place', /^x = \S+; larger ones are left out$/.test(await page.textContent('#cut-place')), await page.textContent('#cut-place'));
  const place = Number((await page.textContent('#cut-place')).split(/[ ;]+/)[2]), point = await pointAt(page, 425, 320);  // within the body
  check('a point that was cut away is not picked', point[0] <= place + 1e-3, point, place);
  await picture(page, folder, 'cut');
  await page.keyboard.press('k');
  const hollow = await seen();
  check('a hollow closing shows its inside', hollow.red > 0.02 && Math.abs(hollow.other - half.other) < 0.02, half, hollow);
  await page.keyboard.press('k');
  for (let i = 0; i < 60; ++i) await page.keyboard.press('.');
  check('a plane beyond everything leaves nothing', (await seen()).other < 0.002, await seen());
  await page.keyboard.press('\\');
  check('turned round it leaves everything', (await seen()).other > 0.98 * whole.other, await seen(), whole);
  for (let i = 0; i < 4; ++i) await page.keyboard.press('x');
  check('the last one is no cut', await page.getAttribute('[data-cut=off]', 'aria-pressed') === 'true');
  check('then all is there again', Math.abs((await seen()).other - whole.other) < 0.001);
  await page.keyboard.press('2');
}

/// Colours by distance, with a legend that agrees with bpcheck; and the ruler, by pointer and by keys.
async function measuring(page) {
  await page.locator('#view').focus();
  await page.keyboard.press('4');
  await page.locator('#files input[type=range]').first().fill('100');
  await page.locator('#view').focus();
  const before = await page.evaluate(() => window.bpview.files());
  await page.keyboard.press('d');
  await page.waitForFunction((n) => window.bpview.files() > n && !document.getElementById('far').hidden, before);
  const s = await state(page), told = Number((await page.textContent('#far-high')).split(' ')[0]);
  const level = Number(await page.locator('#files select').first().inputValue()), bound = s.layers[0].verdict.levels[level].farthest;
  check('the legend agrees with bpcheck', told <= 1.001 * bound && told > 0.9 * bound, told, bound);
  check('the legend tells voxels and percent', / \(\S+ voxels, \S+%\)$/.test(await page.textContent('#far-high')), await page.textContent('#far-high'));
  await picture(page, folder, 'distances');
  const counts = [];
  for (const level of ['0', '1']) {
    const loaded = await page.evaluate(() => window.bpview.files());
    await page.locator('#files select').first().selectOption(level);
    await page.waitForFunction((n) => window.bpview.files() > n, loaded);
    counts.push(await page.locator('#files .count').first().textContent());
  }
  check('with distances a row counts the faces of its level', counts[0] === '800' && counts[1] === '200', counts);
  await page.locator('#view').focus();
  await page.keyboard.press('d');
  await page.waitForFunction(() => document.getElementById('far').hidden);

  for (const look of ['flat', 'smooth', 'edges']) {
    check('faces look otherwise', (await changed(page, { x: 200, y: 80, width: 500, height: 560 }, () => page.keyboard.press('g'))) > 500, look);
    check('the button tells it', await page.getAttribute(`[data-faces=${look}]`, 'aria-pressed') === 'true', look);
    await picture(page, folder, look);
  }

  await page.keyboard.press('4');
  await page.keyboard.press('2');
  await page.keyboard.press('f');
  await page.keyboard.press('r');
  const at = [];
  for (const [x, y] of [[410, 300], [420, 420]]) {
    at.push(await pointAt(page, x, y));
    await page.mouse.down();
    await page.mouse.up();
  }
  const wanted = Math.hypot(...at[0].map((x, i) => x - at[1][i])), text = await page.textContent('#ruler'), found = Number(text.split(' ')[0]);
  check('the ruler measures', Math.abs(found / wanted - 1) < 0.01, found, wanted, text);
  check('the ruler knows voxels', Math.abs(Number(text.split(', ')[1].split(' ')[0]) * s.scene.voxel / wanted - 1) < 0.02, text);
  check('the ruler has a label', await page.isVisible('#ruler-label'));
  await picture(page, folder, 'ruler');
  await page.keyboard.press('Escape');
  check('Escape takes the ruler away', !(await page.isVisible('#ruler-label')) && (await page.textContent('#ruler')) === '');
  // By keys alone: the body goes under the cross, and the view turns around it.
  await page.keyboard.press('f');
  for (let i = 0; i < 2; ++i) await page.keyboard.press('Shift+ArrowLeft');
  await page.keyboard.press('r');
  await page.keyboard.press('Enter');
  for (let i = 0; i < 3; ++i) await page.keyboard.press('Shift+ArrowDown');
  await page.keyboard.press('Enter');
  check('keys alone measure', / in scene units, /.test(await page.textContent('#ruler')), await page.textContent('#ruler'));
  const kept = await page.textContent('#ruler');
  await page.mouse.move(410, 300);
  await page.mouse.down();
  await page.mouse.move(460, 310, { steps: 3 });
  await page.mouse.up();
  check('a drag turns and takes no point', (await page.textContent('#ruler')) === kept);
  await page.keyboard.press('v');
  await page.keyboard.press('2');
}

/// The plot: a point for each proxy and each proven level. A point shows its proxy alone, by click and by key.
async function plotting(page) {
  await page.click('[data-half=design]');
  await page.fill('#faces', '300');
  await page.keyboard.press('Enter');
  let s = await until(page, (q) => q.made.length >= 2 && q.proxy.step === 'ready' && q.proxy.current, 'a second proxy');
  check('proxies are kept with their measures', s.made.every((p) => p.answer === 'proven' && p.triangles > 0 && p.farthest > 0 && p.volume_ratio > 0), s.made);
  check('fewer faces are farther from the scene', s.made.at(-1).triangles < s.made[0].triangles && s.made.at(-1).farthest > s.made[0].farthest, s.made);
  await page.keyboard.press('l');
  const levels = s.layers.flatMap((layer) => layer.verdict?.levels ?? []).filter((level) => level.farthest > 0).length, dots = page.locator('#plot svg').first().locator('circle');
  await page.waitForFunction((n) => document.querySelector('#plot svg').querySelectorAll('circle').length === n, s.made.length + levels);
  await dots.first().click();
  await page.waitForFunction((n) => window.bpview.proxy === n, s.made[0].number);
  check('a point shows its proxy', await page.getAttribute('[data-layer=proxy]', 'aria-pressed') === 'true');
  check('its point is marked', (await dots.first().getAttribute('class')) === 'current');
  check('the proxy is seen', (await colors(page, 200, 80, 500, 560)).other > 0.1);
  await picture(page, folder, 'plot');
  const last = dots.nth(s.made.length + 1);  // the coarser level of the first file
  check('a point says what it is', /^lod\/figure.glb, level 1, 200 faces, farthest /.test(await last.getAttribute('aria-label')), await last.getAttribute('aria-label'));
  await last.focus();
  await page.keyboard.press('Enter');
  check('a point of a file shows the file', await page.locator('#files li').first().locator('input[type=checkbox]').isChecked());
  check('and hides the proxy', await page.getAttribute('[data-layer=proxy]', 'aria-pressed') === 'false');
  await page.click('#prove-all');
  s = await until(page, (q) => q.layers.every((layer) => layer.step === 'done' || layer.kind === 'voxels'), 'all answers');
  check('the answers are counted in view', (await page.textContent('#proofs')) === `${s.layers.length - 1} of ${s.layers.length - 1} proven` && await inView(page, '#proofs'), await page.textContent('#proofs'));
  check('all files are proven', s.layers.every((layer) => layer.kind === 'voxels' || layer.verdict.answer === 'proven'), s.layers);
}

async function main() {
  build();
  const { child, link } = await serve(folder, scene, '--show', 'lod/', '--show', 'tiles', '--show', 'body', '--show', 'cage/figure_cage.obj', '--show', 'fit.ply', '--show', 'closed.bpv');
  const browser = await launch(), troubles = [];
  const page = await open(await browser.newContext({ viewport: { width: 1280, height: 720 } }), link, troubles);
  const names = await files(page);
  await cutting(page);
  await measuring(page);
  await plotting(page);
  // A file that is damaged later is an answer, not an end.
  fs.writeFileSync(path.join(folder, 'fit.ply'), 'ply\nformat ascii 1.0\nelement vertex 3\n');
  await page.reload();
  await page.waitForFunction(() => window.bpview?.ready && window.bpview.files() === 1);
  await page.locator('#files li').nth(names.indexOf('fit.ply')).locator('input[type=checkbox]').click();
  await message(page, 'fit.ply');
  check('nothing went wrong on the page', troubles.every((text) => text.includes('400')), troubles);
  await browser.close();
  await end(child);
  process.exit(checks.failed > 0 ? 1 : 0);
}
main().catch((error) => { console.error(error); process.exit(1); });
