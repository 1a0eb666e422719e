// What the tests of the page share in every browser: bpview started on a scene, and checks that are counted.
const { spawn } = require('child_process');

exports.sleep = (ms) => new Promise((done) => setTimeout(done, ms));

/// Counts what is wrong, and says it.
exports.Checks = class {
  failed = 0;
  check(what, fine, ...facts) { if (!fine) { this.failed++; console.log('FAILED:', what, ...facts); } }
};

/// bpview, once it has printed its link.
exports.serve = (folder, ...args) => {
  const child = spawn('bpview', ['--no-open', ...args], { cwd: folder, stdio: ['ignore', 'pipe', 'inherit'] });
  process.on('exit', () => child.kill('SIGKILL'));  // also when a test fails
  return new Promise((done, fail) => {
    let text = '';
    child.stdout.on('data', (data) => { text += data; if (text.includes('\n')) done({ child, link: text.trim() }); });
    child.on('exit', (code) => fail(new Error(`bpview ended with status ${code}`)));
  });
};

exports.state = (page) => page.evaluate(() => fetch('/api/state').then((r) => r.json()));

/// Waits until the page has heard of its own edits, and its state is as `done` says. Returns the state.
exports.until = async (page, done, what) => {
  for (let i = 0; i < 1200; ++i, await exports.sleep(50)) {
    const s = await page.evaluate(() => (window.bpview.settled() ? window.bpview.state() : null));
    if (s && done(s)) return s;
  }
  throw new Error(`waited in vain: ${what}`);
};

/// Waits until the page shows a message with these words: one from before may still be there.
exports.message = async (page, words) => {
  for (let i = 0, shown = ''; ; ++i, await exports.sleep(50)) {
    shown = await page.evaluate(() => { const box = document.getElementById('message'); return box.hidden ? '' : box.textContent; });
    if (shown.includes(words)) return;
    if (i === 1200) throw new Error(`waited in vain for a message with “${words}”; shown is “${shown}”`);
  }
};

/// Waits for frames. The page looks under the pointer in the first one after an event, and draws what is found there in the second one.
exports.drawn = (page, frames = 2) => page.evaluate((all) => new Promise((done) => {
  const next = (n) => (n === 0 ? done() : requestAnimationFrame(() => next(n - 1)));
  next(all);
}), frames);

exports.end = (child) => {
  child.kill('SIGINT');
  return new Promise((done) => child.on('exit', done));
};
