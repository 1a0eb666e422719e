// The page of bpview in Firefox: it opens, is brushed, undone and saved.   node firefox.cjs FOLDER SCENE
// FOLDER holds the scene, and gets rules, proxy and a picture. FIREFOX: the browser, else firefox-esr. Exit status 1 if something is wrong.
const fs = require('fs'), path = require('path');
const puppeteer = require('puppeteer-core');
const { Checks, drawn, end, serve, sleep, until: waitUntil } = require('./served.cjs');
const [folder, scene] = process.argv.slice(2);
const checks = new Checks(), check = (...args) => checks.check(...args);

async function main() {
  const { child, link } = await serve(folder, scene);
  const browser = await puppeteer.launch({ browser: 'firefox', protocol: 'webDriverBiDi', executablePath: process.env.FIREFOX || '/usr/bin/firefox-esr', headless: false,  // headless Firefox has no WebGL without a GPU, so page.sh gives it a screen
   
    extraPrefsFirefox: { 'webgl.force-enabled': true, 'app.update.enabled': false, 'datareporting.policy.dataSubmissionEnabled': false, 'network.captive-portal-service.enabled': false } });
  const page = await browser.newPage(), troubles = [];
  page.setDefaultTimeout(60000);
  page.on('pageerror', (error) => troubles.push(error.message));
  page.on('console', (message) => { if (message.type() === 'error') troubles.push(message.text()); });
  await page.setViewport({ width: 1280, height: 720 });
  await page.goto(link);
  await page.waitForFunction(() => window.bpview?.ready && window.bpview.generation > 0);
  const until = (done, what) => waitUntil(page, done, what);
  check('the token leaves the address', !page.url().includes('#'), page.url());
  let s = await until((q) => q.proxy.step === 'ready' && q.proxy.current, 'the first proxy');
  check('the first proxy is proven', s.proxy.verdict.answer === 'proven', s.proxy);

  const box = await (await page.$('#canvas')).boundingBox(), x = box.x + box.width * 0.44, y = box.y + box.height / 2;  // the body
  await page.keyboard.press('b');
  await page.mouse.move(x, y - 30);
  await page.mouse.down();
  for (const step of [0, 30, 60]) { await page.mouse.move(x, y + step, { steps: 4 }); await drawn(page, 1); }
  await page.mouse.up();
  s = await until((q) => q.design.rules.length === 1 && q.closing.shown === q.design.revision, 'a stroke');
  check('a stroke has several points', Array.isArray(s.design.rules[0].at[0]), s.design.rules[0]);
  await page.waitForFunction((n) => window.bpview.revision >= n, {}, s.design.revision);
  const brushed = s.closing.voxels;
  await page.keyboard.down('Control');
  await page.keyboard.press('z');
  await page.keyboard.up('Control');
  s = await until((q) => q.design.rules.length === 0 && q.closing.shown === q.design.revision, 'the stroke undone');
  check('without the stroke the closing is another', s.closing.voxels !== brushed, s.closing.voxels, brushed);
  await page.click('#redo');
  s = await until((q) => q.design.rules.length === 1 && q.proxy.step === 'ready' && q.proxy.current, 'the stroke again, and its proxy');
  check('the closing is that of the stroke', s.closing.voxels === brushed, s.closing.voxels, brushed);
  await page.keyboard.press('3');
  await page.waitForFunction((n) => window.bpview.proxy === n, {}, s.proxy.number);
  await page.waitForFunction(() => !document.getElementById('save-proxy').disabled);
  await page.click('#save-rules');
  await page.click('#save-proxy');
  for (const name of ['rules.json', 'proxy.glb']) {
    for (let i = 0; i < 200 && !fs.existsSync(path.join(folder, name)); ++i) await sleep(50);
    check('a file is saved', fs.existsSync(path.join(folder, name)), name);
  }
  await drawn(page);
  await page.screenshot({ path: path.join(folder, 'firefox.png') });
  check('nothing went wrong on the page', troubles.length === 0, troubles);
  await browser.close();
  await end(child);
  process.exit(checks.failed > 0 ? 1 : 0);
}
main().catch((error) => { console.error(error); process.exit(1); });
