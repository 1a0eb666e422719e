// The page of bpview by the keyboard alone, all of it but strokes:  node keys.cjs FOLDER SCENE
// FOLDER holds the scene, and gets rules, proxy and a picture. Exit status 1 if something is wrong.
const fs = require('fs'), path = require('path');
const { execFileSync } = require('child_process');
const { Checks, end, launch, open, picture, serve, state, until } = require('./browser.cjs');
const [folder, scene] = process.argv.slice(2);
const checks = new Checks(), check = (...args) => checks.check(...args);

async function main() {
  execFileSync('bplod', [scene, '--faces', '800,200', '-o', 'lod', '-q'], { cwd: folder, stdio: ['ignore', 'ignore', 'inherit'] });
  const { child, link } = await serve(folder, scene, '--show', 'lod/figure.glb');
  const browser = await launch(), troubles = [];
  const page = await open(await browser.newContext({ viewport: { width: 1280, height: 720 } }), link, troubles);
  const keys = page.keyboard;
  /// Presses Tab until the element has the focus, and looks that the focus is seen.
  const tabTo = async (selector) => {
    for (let i = 0; i < 150; ++i) {
      if (await page.evaluate((s) => document.activeElement?.matches(s), selector)) {
        const seen = await page.evaluate(() => { const s = getComputedStyle(document.activeElement); return s.outlineStyle !== 'none' || s.boxShadow !== 'none' || s.strokeWidth === '3px'; });
        return check('the focus is seen', seen, selector);
      }
      await keys.press('Tab');
    }
    check('Tab reaches it', false, selector);
  };
  /// Types over a text that Tab has chosen.
  const type = async (selector, text) => { await tabTo(selector); await keys.press('Control+a'); await keys.type(text); await keys.press('Enter'); };
  const press = async (selector) => { await tabTo(selector); await keys.press('Enter'); };

  // Look: a file, its level, a cut, distances, the ruler, a proof, the plot.
  await tabTo('#files input[type=checkbox]');
  await keys.press('Space');
  check('a file is hidden', !(await page.isChecked('#files input[type=checkbox]')));
  await keys.press('Space');
  await tabTo('#files select');
  await keys.press('ArrowDown');
  await page.waitForFunction(() => document.querySelector('#files .count').textContent === '200');
  await tabTo('#files input[type=range]');
  await keys.press('ArrowRight');
  await press('#files .line button');
  await until(page, (q) => q.layers[0].step === 'done' && q.layers[0].verdict.answer === 'proven', 'a proof');
  await press('[data-cut=x]');
  check('the cut is on', await page.isEnabled('#cut'));
  await tabTo('#cut');
  await keys.press('ArrowRight');
  await press('[data-cut=off]');
  await tabTo('#distances');
  await keys.press('Space');
  await page.waitForFunction(() => !document.getElementById('far').hidden);
  await keys.press('d');
  await tabTo('#plot circle');
  await keys.press('Enter');
  await keys.press('Escape');

  // Design: base, brush, mirror, part, cubes, faces, live, mesh, undo, save.
  await keys.press('l');
  await tabTo('#base-slide');
  await keys.press('ArrowLeft');
  let s = await until(page, (q) => q.design.base !== '2%', 'another base');
  await type('#base', '3%');
  await until(page, (q) => q.design.base === '3%', 'a typed base');
  await type('#target', '1%');
  await type('#radius', '4%');
  await press('[data-mirror=z]');
  await type('#mirror-at', '0.1');
  check('the mirror plane has its place', await page.inputValue('#mirror-at') === '0.1');
  const names = await page.evaluate(() => [...document.querySelectorAll('#part-names option')].map((o) => o.value));
  await type('#part', names[0]);
  await press('#part-finer');
  s = await until(page, (q) => q.design.rules.length === 1, 'a rule by name');
  check('the rule has the scale of the brush', s.design.rules[0].scale === '1%', s.design.rules[0]);
  await press('#undo');
  await until(page, (q) => q.design.rules.length === 0, 'undone');
  await press('#redo');
  await until(page, (q) => q.design.rules.length === 1, 'done again');
  await press('summary');
  await press('[data-cubes=frame]');
  await until(page, (q) => q.design.orientation?.length === 1, 'a frame');
  for (const [field, value] of [['x', '0.1'], ['rz', '20']]) await type(`#frame-${field}`, value);
  s = await until(page, (q) => q.design.orientation[0].at[0] === 0.1 && q.design.orientation[0].frame[3] > 0.1, 'a frame by numbers');
  await press('#frames li button:last-child');
  await until(page, (q) => q.design.orientation === null, 'the frame removed');
  await keys.press('Control+z');
  await until(page, (q) => q.design.orientation?.length === 1, 'the frame again');
  await type('#faces', '500');
  await until(page, (q) => q.faces === 500, 'other faces');
  await tabTo('#live');
  await keys.press('Space');
  await until(page, (q) => !q.live && !['meshing', 'checking'].includes(q.proxy.step), 'no proxy after each stroke');
  await press('#rules button');
  await until(page, (q) => q.design.rules.length === 0 && q.closing.shown === q.design.revision, 'the rule removed');
  await press('#mesh');
  await until(page, (q) => q.proxy.step === 'ready' && q.proxy.current, 'a proxy');
  await page.waitForFunction(() => !document.getElementById('save-proxy').disabled);
  await press('#save-rules');
  await press('#save-proxy');
  await until(page, () => fs.existsSync(path.join(folder, 'rules.json')) && fs.existsSync(path.join(folder, 'proxy.glb')), 'saved files');
  await tabTo('#copy');

  // The view and its layers.
  await tabTo('#view');
  const frames = await page.evaluate(() => window.bpview.frames());
  for (const key of ['ArrowLeft', 'Shift+ArrowUp', '+', 'f', '1', '2', '3']) await keys.press(key);
  await page.waitForFunction((n) => window.bpview.frames() > n, frames);
  for (const layer of ['scene', 'closing', 'proxy']) await press(`[data-layer=${layer}]`);
  for (const tool of ['turn', 'ruler']) { await press(`[data-tool=${tool}]`); check('a tool is chosen', await page.getAttribute(`[data-tool=${tool}]`, 'aria-pressed') === 'true', tool); }
  await picture(page, folder, 'keys');
  check('nothing went wrong on the page', troubles.length === 0, troubles);
  await browser.close();
  await end(child);
  process.exit(checks.failed > 0 ? 1 : 0);
}
main().catch((error) => { console.error(error); process.exit(1); });
