// Bundles the page, and writes it as a C++ source:  node build.mjs OUT.cpp
// NODE_PATH names the folder of the packages of package-lock.json.
import { createRequire } from 'node:module';
import { readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';

const here = dirname(fileURLToPath(import.meta.url));
const { build } = createRequire(join(process.env.NODE_PATH, 'x'))('esbuild');
const bundle = await build({
  entryPoints: [join(here, 'src/main.ts')], bundle: true, minify: true, write: false, format: 'esm', target: 'es2022',
  legalComments: 'eof', nodePaths: [process.env.NODE_PATH],
});
const files = [
  ['/index.html', 'text/html; charset=utf-8', readFileSync(join(here, 'index.html'))],
  ['/icon.svg', 'image/svg+xml', readFileSync(join(here, 'icon.svg'))],
  ['/page.css', 'text/css; charset=utf-8', readFileSync(join(here, 'page.css'))],
  ['/page.js', 'text/javascript; charset=utf-8', bundle.outputFiles[0].contents],
];
let arrays = '', table = '', total = 0;
for (const [i, [path, type, content]] of files.entries()) {
  const bytes = gzipSync(content, { level: 9 });
  total += bytes.length;
  arrays += `constexpr unsigned char kFile${i}[] = {${bytes.join(',')}};\n`;
  table += `    {"${path}", "${type}", kFile${i}},\n`;
}
const most = 400e3;
if (total > most) throw new Error(`the page has ${total} bytes; at most ${most} are allowed`);
writeFileSync(process.argv[2], `#include "tools/view/page_files.h"

namespace bp {

namespace {

${arrays}
constexpr PageFile kFiles[] = {
${table}};

}  // namespace

std::span<const PageFile> page_files() {
  return kFiles;
}

}  // namespace bp
`);
console.log(`page: ${total} bytes`);
