// Tells whether triangles bound a solid: only then a cut through them can be filled.

/// Mixes a number into a hash of 32 bits (the steps of MurmurHash3).
function mix(hash: number, value: number): number {
  let k = Math.imul(value, 0xcc9e2d51);
  k = Math.imul((k << 15) | (k >>> 17), 0x1b873593);
  const h = hash ^ k;
  return (Math.imul((h << 13) | (h >>> 19), 5) + 0xe6546b64) | 0;
}
const finish = (hash: number): number => { const h = Math.imul(hash ^ (hash >>> 16), 0x85ebca6b); return h ^ (h >>> 13); };

/// Returns a hash of each position, by its bits; the two zeros are one number.
function hashes(positions: Float32Array, seed: number): Int32Array {
  const bits = new Int32Array(positions.buffer, positions.byteOffset, positions.length), all = new Int32Array(positions.length / 3);
  for (let i = 0, at = 0; i < all.length; ++i) {
    let h = seed;
    for (let k = 0; k < 3; ++k, ++at) h = mix(h, positions[at] === 0 ? 0 : bits[at]);
    all[i] = finish(h);
  }
  return all;
}

/// Returns whether each edge occurs as often in one direction as in the other. Vertices are the same where their positions are. Sums of hashes
/// are compared instead of tables of edges: two sums of 32 bits are wrong once in 2^64, and take a tenth of a second for a million triangles.
export function isClosed(positions: Float32Array, corners: Uint32Array | null): boolean {
  const count = corners ? corners.length : positions.length / 3;
  return [0x2545f491, 0x5851f42d].every((seed) => {
    const of = hashes(positions, seed);
    let sum = 0;
    for (let t = 0; t < count; t += 3) {
      for (let k = 0; k < 3; ++k) {
        const i = t + k, j = t + ((k + 1) % 3), a = of[corners ? corners[i] : i], b = of[corners ? corners[j] : j];
        sum = (sum + finish(mix(a, b)) - finish(mix(b, a))) | 0;
      }
    }
    return sum === 0;
  });
}
