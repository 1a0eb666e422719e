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

exports.end = (child) => {
  child.kill('SIGINT');
  return new Promise((done) => child.on('exit', done));
};
