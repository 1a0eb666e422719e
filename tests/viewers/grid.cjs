// Pictures side by side, row by row:  node grid.cjs COLUMNS WIDTH OUT.png FILE.png...
// All have this width, and the shape of the first. Package: playwright-core (NODE_PATH).
const fs = require('fs');
const { chromium } = require('playwright-core');
const [columns, width, out, ...files] = process.argv.slice(2);

async function main() {
  const browser = await chromium.launch({ executablePath: process.env.CHROMIUM || '/usr/bin/chromium', args: ['--no-sandbox', '--disable-background-networking'] });
  try {
    const page = await browser.newPage();
    const images = files.map((file) => `data:image/png;base64,${fs.readFileSync(file).toString('base64')}`);
    const size = await page.evaluate(async ([all, n, width]) => {
      document.body.style = `margin: 0; display: grid; grid-template-columns: repeat(${n}, max-content)`;
      const shown = all.map((src) => Object.assign(new Image(), { src }));
      await Promise.all(shown.map((image) => image.decode()));
      const height = Math.round(width * shown[0].naturalHeight / shown[0].naturalWidth);
      shown.forEach((image) => { image.style = `display: block; width: ${width}px; height: ${height}px`; });
      document.body.append(...shown);
      return { width: width * n, height: height * Math.ceil(all.length / n) };
    }, [images, +columns, +width]);
    await page.setViewportSize(size);
    await page.screenshot({ path: out });
  } finally {
    await browser.close();
  }
}
main().catch((error) => { console.error(error.message); process.exit(1); });
