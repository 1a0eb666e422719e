// LDR-FLIP of [ANA20], from the paper: how much a person sees change who flips between two pictures, for each pixel from 0 to 1.
// A picture is { data, width, height } with sRGB bytes, four for each pixel. What the paper leaves open: past the border the border's
// colours go on, and white is the white of the matrix.
const pixelsPerDegree = 67;  // of the paper: 0.7 m from a screen of 3840 pixels and 0.7 m
const toXyz = [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]];  // IEC 61966-2-1
const white = toXyz.map((row) => row[0] + row[1] + row[2]);
const toRgb = inverse(toXyz);

function inverse(m) {
  const minor = (i, j) => m[(i + 1) % 3][(j + 1) % 3] * m[(i + 2) % 3][(j + 2) % 3] - m[(i + 1) % 3][(j + 2) % 3] * m[(i + 2) % 3][(j + 1) % 3];
  const det = m[0].reduce((sum, x, j) => sum + x * minor(0, j), 0);
  return m.map((_, i) => m.map((_, j) => minor(j, i) / det));
}
const times = (m, [x, y, z]) => m.map((row) => row[0] * x + row[1] * y + row[2] * z);
const linear = (c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);

// A filter is a kernel [weight of offset -r, ... r]; what it makes of each line of a plane, then of each column.
function filter(plane, width, height, alongX, alongY) {
  const r = (alongX.length - 1) / 2, lines = new Float64Array(plane.length), out = new Float64Array(plane.length);
  for (let i = 0; i < plane.length; ++i) {
    const x = i % width, start = i - x;
    for (let k = -r; k <= r; ++k) lines[i] += alongX[k + r] * plane[start + Math.min(Math.max(x + k, 0), width - 1)];
  }
  for (let i = 0; i < plane.length; ++i) {
    const x = i % width, y = (i - x) / width;
    for (let k = -r; k <= r; ++k) out[i] += alongY[k + r] * lines[x + width * Math.min(Math.max(y + k, 0), height - 1)];
  }
  return out;
}
const kernel = (r, weight) => Array.from({ length: 2 * r + 1 }, (_, i) => weight(i - r));
const sum = (values) => values.reduce((a, b) => a + b, 0);

// What eyes resolve of light, red-green and blue-yellow: sums of Gaussians a (pi / b)^(1/2) exp(-(pi d)^2 / b), d in degrees.
const sensitivity = [[[1, 0.0047]], [[1, 0.0053]], [[34.1, 0.04], [13.5, 0.025]]];
const blur = Math.ceil(3 * Math.sqrt(0.04 / (2 * Math.PI ** 2)) * pixelsPerDegree);
function resolved(plane, width, height, gaussians) {
  const parts = gaussians.map(([a, b]) => {
    const line = kernel(blur, (d) => Math.exp(-((Math.PI * d / pixelsPerDegree) ** 2) / b)), scale = a * Math.sqrt(Math.PI / b);
    return { seen: filter(plane, width, height, line, line), scale, whole: scale * sum(line) ** 2 };
  });
  const whole = sum(parts.map((p) => p.whole));
  return plane.map((_, i) => sum(parts.map((p) => p.scale * p.seen[i])) / whole);
}

// CIELAB with colours that fade with light, as Hunt saw: of linear RGB.
function faded(rgb) {
  const [x, y, z] = times(toXyz, rgb).map((v, i) => v / white[i]).map((t) => (t > (6 / 29) ** 3 ? Math.cbrt(t) : t * (29 / 6) ** 2 / 3 + 4 / 29));
  const light = 116 * y - 16;
  return [light, 0.01 * light * 500 * (x - y), 0.01 * light * 200 * (y - z)];
}
const distance = (p, q) => Math.abs(p[0] - q[0]) + Math.hypot(p[1] - q[1], p[2] - q[2]);  // HyAB
const farthest = distance(faded([0, 1, 0]), faded([0, 0, 1])) ** 0.7;

// From 0 to 1: 0.95 is reached at 0.4 of the farthest.
function colorError(p, q) {
  const e = distance(p, q) ** 0.7, knee = 0.4 * farthest;
  return e < knee ? 0.95 * e / knee : 0.95 + 0.05 * (e - knee) / (farthest - knee);
}

// Edges and points as derivatives of a Gaussian find them, 0.082 degrees wide; weights of one sign sum to 1.
const sigma = 0.5 * 0.082 * pixelsPerDegree, reach = Math.ceil(3 * sigma);
const bell = kernel(reach, (d) => Math.exp(-d * d / (2 * sigma * sigma)));
const smooth = bell.map((w) => w / sum(bell));
const signed = (weights) => {
  const up = sum(weights.filter((w) => w > 0)), down = -sum(weights.filter((w) => w < 0));
  return weights.map((w) => w / (w > 0 ? up : down));
};
const slope = signed(bell.map((w, i) => (i - reach) * w)), bend = signed(bell.map((w, i) => (((i - reach) / sigma) ** 2 - 1) * w));

// What of a picture is compared: colours as they are resolved, and how much edge and how much point is at each pixel.
export function seen({ data, width, height }) {
  const opponent = [0, 1, 2].map(() => new Float64Array(width * height)), light = new Float64Array(width * height);
  for (let i = 0; i < light.length; ++i) {
    const [x, y, z] = times(toXyz, [0, 1, 2].map((k) => linear(data[4 * i + k] / 255))).map((v, k) => v / white[k]);
    [y, x - y, y - z].forEach((v, k) => (opponent[k][i] = v));
    light[i] = y;
  }
  const [ys, xs, zs] = opponent.map((plane, k) => resolved(plane, width, height, sensitivity[k]));
  const colors = Array.from(ys, (y, i) => {
    const xyz = [y + xs[i], y, y - zs[i]].map((v, k) => v * white[k]);
    return faded(times(toRgb, xyz).map((v) => Math.min(Math.max(v, 0), 1)));
  });
  const strength = (line) => {
    const x = filter(light, width, height, line, smooth), y = filter(light, width, height, smooth, line);
    return x.map((v, i) => Math.hypot(v, y[i]));
  };
  return { colors, edges: strength(slope), points: strength(bend) };
}

// FLIP of two pictures of one size, given by what is seen of them; a Float64Array with a value for each pixel.
export function flip(a, b) {
  return Float64Array.from(a.colors, (color, i) => {
    const feature = Math.max(Math.abs(a.edges[i] - b.edges[i]), Math.abs(a.points[i] - b.points[i]));
    return colorError(color, b.colors[i]) ** (1 - Math.sqrt(feature / Math.SQRT2));
  });
}
