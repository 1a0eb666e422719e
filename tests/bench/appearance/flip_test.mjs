// node flip_test.mjs: FLIP of pictures whose values can be worked out by hand.
import assert from 'node:assert';
import { flip, seen } from './flip.mjs';

const width = 48, height = 30;
const picture = (color) => {
  const data = new Uint8Array(4 * width * height);
  for (let i = 0; i < width * height; ++i) data.set([...color(i % width, Math.floor(i / width)), 255], 4 * i);
  return { data, width, height };
};
const plain = (...rgb) => picture(() => rgb);
const compare = (a, b) => flip(seen(a), seen(b));
const near = (value, expected, margin) => assert.ok(Math.abs(value - expected) < margin, `${value} is not ${expected}`);
let state = 1;
const noise = () => picture(() => [0, 0, 0].map(() => (state = (state * 48271) % 2147483647) % 256));

const [one, other] = [noise(), noise()];
assert.ok(compare(one, one).every((v) => v === 0), 'the same picture');
assert.ok(compare(one, other).every((v) => v > 0 && v <= 1), 'between 0 and 1');
assert.deepEqual(compare(one, other), compare(other, one), 'symmetric');

// Without edges a difference of colours is left. Green and blue are the farthest; black and white are 100 apart in light:
// 100 ** 0.7 of 203.31 ** 0.7, and 0.95 is at 0.4 of it.
compare(plain(0, 255, 0), plain(0, 0, 255)).forEach((v) => near(v, 1, 1e-9));
const bend = (e) => { const t = e ** 0.7 / 203.31 ** 0.7; return t < 0.4 ? 0.95 * t / 0.4 : 0.95 + 0.05 * (t - 0.4) / 0.6; };
compare(plain(0, 0, 0), plain(255, 255, 255)).forEach((v) => near(v, bend(100), 1e-4));
const grey = ((128 / 255 + 0.055) / 1.055) ** 2.4;
const lightness = (y) => 116 * Math.cbrt(y) - 16;
compare(plain(0, 0, 0), plain(128, 128, 128)).forEach((v) => near(v, bend(lightness(grey)), 1e-4));

// Grey from a column on, and black. Far from it: as above. At it the edge is as strong as the grey, and of the light arrive the half
// and half of the weight in the middle of the kernel: exp(-(pi d / 67)^2 / 0.0047) for d pixels.
const half = compare(plain(0, 0, 0), picture((x) => Array(3).fill(x < 24 ? 0 : 128)));
let weights = 0;
for (let d = -10; d <= 10; ++d) weights += Math.exp(-((Math.PI * d / 67) ** 2) / 0.0047);
const arrives = bend(lightness(grey * (1 + 1 / weights) / 2));
for (let y = 0; y < height; ++y) {
  near(half[width * y], 0, 1e-9);
  near(half[width * y + 47], bend(lightness(grey)), 1e-4);
  near(half[width * y + 24], arrives ** (1 - Math.sqrt(grey / Math.SQRT2)), 1e-4);
}
// The same along y.
const turned = compare({ data: plain(0, 0, 0).data, width: height, height: width },
  { data: picture(() => [0, 0, 0]).data.fill(128, 4 * height * 24), width: height, height: width });
near(turned[height * 24 + 7], half[24], 1e-12);
console.log('FLIP: as worked out by hand');
