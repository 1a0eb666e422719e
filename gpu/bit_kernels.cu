// Cube dilation: where the radius is constant it is a windowed OR in y and z (a table of power-of-two windows, two
// overlapping look-ups per axis as in a sparse table of range maxima), then a widening of words in x. Where the radius
// varies, the same table answers every radius of its octave, so a word asks only for the radii that occur in it.
#include "gpu/bit_kernels.h"
#include "gpu/launch.h"

namespace bp {

namespace {

unsigned blocks_for(std::uint64_t threads) {
  return unsigned((threads + kPassThreads - 1) / kPassThreads);
}

/// Thread number -> word w of cell row cy in slice z; one thread walks the 8 rows of the cell row.
struct CellRow {
  std::int32_t w, cy, z;
};
__device__ CellRow cell_row(const GridShape& s, unsigned i) {
  const unsigned rest = i / unsigned(s.words);
  return {int(i - rest * unsigned(s.words)), int(rest % unsigned(s.cells_y())), int(rest / unsigned(s.cells_y()))};
}
unsigned cell_rows(const GridShape& s) {
  return s.word_count() / kCell;
}

__global__ void __launch_bounds__(kPassThreads)
    pack_kernel(const std::uint32_t* __restrict__ from, BoxOfWords box, GridShape shape,
                std::uint32_t* __restrict__ bits, std::uint32_t* __restrict__ cells) {
  const unsigned i = thread_in_grid();
  if (i >= shape.word_count() / kCell) return;
  const CellRow r = cell_row(shape, i);
  const int sw = r.w - box.w0, sz = r.z - box.z0, sy0 = r.cy * kCell - box.y0;
  const bool inside = sw >= 0 && sw < box.words && sz >= 0 && sz < box.nz;
  std::uint32_t v[kCell], any = 0;
#pragma unroll
  for (int j = 0; j < kCell; ++j) {
    const int sy = sy0 + j;
    v[j] = inside && sy >= 0 && sy < box.ny ? from[(std::int64_t(sz) * box.ny + sy) * box.words + sw] : 0;
  }
#pragma unroll
  for (int j = 0; j < kCell; ++j) {
    bits[shape.word(r.w, r.cy * kCell + j, r.z)] = v[j];
    any |= v[j];
  }
  if (any) atomicOr(&cells[shape.quad(r.w, r.cy, r.z / kCell)], spread_bytes(any));
}

__global__ void __launch_bounds__(kPassThreads)
    unpack_kernel(const std::uint32_t* __restrict__ bits, GridShape shape, BoxOfWords box, VoxelRange keep,
                  std::uint32_t* __restrict__ to) {
  const std::int64_t n = std::int64_t(box.words) * box.ny * box.nz;
  for (std::int64_t i = thread_in_grid(); i < n; i += std::int64_t(gridDim.x) * blockDim.x) {
    const int w = int(i % box.words) + box.w0, y = int(i / box.words % box.ny) + box.y0,
              z = int(i / (std::int64_t(box.words) * box.ny)) + box.z0;
    const bool inside = w >= 0 && w < shape.words && y >= 0 && y < shape.ny && z >= 0 && z < shape.nz;
    to[i] = inside ? bits[shape.word(w, y, z)] & keep.mask(w, y, z) : 0;
  }
}

/// One axis of a windowed OR, as runs of `n` words `stride` apart.
struct WindowAxis {
  std::uint32_t stride, n, inner, outer_stride, runs;  ///< runs: chunks of kRun outputs along the axis
};

/// out[j] = in[j] | ... | in[j + length - 1], kRun consecutive j per thread: what all of them share is read and joined
/// once, the two ragged ends are running ORs. (length + kRun - 1) / kRun reads per output.
template <int kRun>
__global__ void __launch_bounds__(kPassThreads)
    window_kernel(const std::uint32_t* __restrict__ in, std::uint32_t* __restrict__ out, WindowAxis axis, int length,
                  unsigned threads) {
  const unsigned i = thread_in_grid();
  if (i >= threads) return;
  const unsigned rest = i / axis.inner, run = rest % axis.runs;
  const std::size_t base = std::size_t(rest / axis.runs) * axis.outer_stride + (i - rest * axis.inner);
  const int first = int(run) * kRun, n = int(axis.n);
  const auto read = [&](int j) { return j < n ? in[base + std::size_t(j) * axis.stride] : 0u; };
  std::uint32_t left[kRun];
#pragma unroll
  for (int t = 0; t < kRun; ++t) left[t] = t < kRun - 1 ? read(first + t) : 0;
  std::uint32_t core = 0;
#pragma unroll 8
  for (int j = kRun - 1; j < length; ++j) core |= read(first + j);
#pragma unroll
  for (int t = kRun - 2; t >= 0; --t) left[t] |= left[t + 1];
  std::uint32_t right = core;
#pragma unroll
  for (int t = 0; t < kRun; ++t) {
    if (t > 0) right |= read(first + length - 1 + t);
    if (first + t < n) out[base + std::size_t(first + t) * axis.stride] = left[t] | right;
  }
}

void window_pass(const std::uint32_t* in, std::uint32_t* out, WindowAxis axis, unsigned lines, int length,
                 cudaStream_t stream) {
  const auto go = [&](auto kernel, unsigned run) {
    axis.runs = (axis.n + run - 1) / run;
    const unsigned threads = lines * axis.runs;
    launch("window_kernel", kernel, blocks_for(threads), kPassThreads, 0, stream, in, out, axis, length, threads);
  };
  if (length >= 32) return go(window_kernel<32>, 32);
  if (length >= 16) return go(window_kernel<16>, 16);
  if (length >= 8) return go(window_kernel<8>, 8);
  if (length >= 4) return go(window_kernel<4>, 4);
  go(window_kernel<2>, 2);
}

/// Voxels of a word within r of a set voxel of the same word.
__device__ std::uint32_t widen(std::uint32_t v, int r) {
  for (int reach = 0;
       reach < r && reach < 31;) {  // a step of reach + 1 at most, or a run cut at the word's end would tear
    const int step = min(reach + 1, r - reach);
    v |= v << step | v >> step;
    reach += step;
  }
  return v;
}

/// Four windows of `length` that cover the window of radius r around (y, z), as row numbers of the table.
struct Rows {
  std::uint32_t row[4];
};
__device__ Rows rows_around(const GridShape& s, int length, int r, int y, int z) {
  const int ya = max(y - r, 0), za = max(z - r, 0), yb = max(y + r + 1 - length, 0), zb = max(z + r + 1 - length, 0);
  return {{s.word(0, ya, za), s.word(0, yb, za), s.word(0, ya, zb), s.word(0, yb, zb)}};
}
__device__ std::uint32_t word_of_rows(const std::uint32_t* __restrict__ table, const Rows& rows, int w) {
  return table[rows.row[0] + w] | table[rows.row[1] + w] | table[rows.row[2] + w] | table[rows.row[3] + w];
}

/// Voxels of word w of a row whose cube of radius r meets G.
__device__ std::uint32_t cube_word(const std::uint32_t* __restrict__ table, int length, const GridShape& s, int r,
                                   int w, int y, int z) {
  const Rows rows = rows_around(s, length, r, y, z);
  const std::uint32_t centre = word_of_rows(table, rows, w);
  if (centre == ~0u || r == 0) return centre;
  std::uint32_t out = widen(centre, r);
  for (int k = 1; 32 * (k - 1) < r && w + k < s.words; ++k) {
    const std::uint32_t v = word_of_rows(table, rows, w + k);
    if (v == 0) continue;
    const int first = 32 * k + __ffs(int(v)) - 1 - r;  // first voxel in reach of it
    if (first < 32) out |= ~0u << max(first, 0);
    break;
  }
  for (int k = 1; 32 * (k - 1) < r && w - k >= 0; ++k) {
    const std::uint32_t v = word_of_rows(table, rows, w - k);
    if (v == 0) continue;
    const int last = r - 32 * (k - 1) - 1 - __clz(int(v));
    if (last >= 0) out |= ~0u >> max(31 - last, 0);
    break;
  }
  return out;
}

__global__ void __launch_bounds__(kPassThreads)
    dilate_cube_kernel(const std::uint32_t* __restrict__ table, int length, GridShape shape, VoxelRange region, int r,
                       std::uint32_t* __restrict__ out) {
  const unsigned i = thread_in_grid();
  if (i >= shape.word_count()) return;
  const unsigned rest = i / unsigned(shape.words);
  const int w = int(i - rest * unsigned(shape.words)), y = int(rest % unsigned(shape.ny)),
            z = int(rest / unsigned(shape.ny));
  const std::uint32_t mask = region.mask(w, y, z);
  out[i] = mask ? cube_word(table, length, shape, r, w, y, z) & mask : 0;
}

/// The scale along one word: 64 S at its five lattice corners, so that S is linear in between.
struct WordScale {
  std::uint32_t corner[5];
  __device__ WordScale(const ScaleView& s, int w, int y, int z) {
#pragma unroll
    for (int i = 0; i < 5; ++i) corner[i] = s.column(4 * w + i, y, z);
  }
  /// Bounds of r over the word (the last corner belongs to the next word: the bound need not be attained).
  __device__ int least() const {
    std::uint32_t m = corner[0];
#pragma unroll
    for (int i = 1; i < 5; ++i) m = min(m, corner[i]);
    return int(m >> 6) / kScaleOne;
  }
  __device__ int most() const {
    std::uint32_t m = corner[0];
#pragma unroll
    for (int i = 1; i < 5; ++i) m = max(m, corner[i]);
    return int(m >> 6) / kScaleOne;
  }
  /// Voxels with r >= radius: 512 S is a sum that grows by the same amount from voxel to voxel within a cell.
  __device__ std::uint32_t at_least(int radius) const {
    const std::int32_t bound = radius * kScaleOne * 512;
    std::uint32_t bits = 0;
#pragma unroll
    for (int c = 0; c < 4; ++c) {
      std::int32_t sum = std::int32_t(corner[c]) * 8;
      const std::int32_t slope = std::int32_t(corner[c + 1]) - std::int32_t(corner[c]);
#pragma unroll
      for (int i = 0; i < 8; ++i) {
        bits |= sum >= bound ? 1u << (8 * c + i) : 0u;
        sum += slope;
      }
    }
    return bits;
  }
};

__global__ void __launch_bounds__(kPassThreads)
    dilate_cube_varying_kernel(const std::uint32_t* __restrict__ table, int length,
                               const std::uint32_t* __restrict__ bits, GridShape shape, VoxelRange region,
                               ScaleView scale, bool first, std::uint32_t* __restrict__ out) {
  const unsigned i = thread_in_grid();
  if (i >= shape.word_count()) return;
  const unsigned rest = i / unsigned(shape.words);
  const int w = int(i - rest * unsigned(shape.words)), y = int(rest % unsigned(shape.ny)),
            z = int(rest / unsigned(shape.ny));
  const std::uint32_t mask = region.mask(w, y, z);
  std::uint32_t have = first ? bits[i] & mask : out[i];  // G itself answers for r = 0
  if ((mask & ~have) != 0) {
    const WordScale s(scale, w, y, z);
    // radii of this table: length <= 2r+1 < 2 length
    const int from = max(s.least(), length / 2), to = min(s.most(), length - 1);
    if (from <= to) {
      const std::uint32_t widest = cube_word(table, length, shape, to, w, y, z) & mask & ~have;
      if (widest != 0) {
        for (int r = from; r <= to; ++r) {
          const std::uint32_t open = widest & ~have & s.at_least(r);
          if (open == 0) continue;
          have |= open & (r == to ? widest : cube_word(table, length, shape, r, w, y, z));
        }
      }
    }
  }
  out[i] = have;
}

__global__ void __launch_bounds__(kPassThreads)
    contour_kernel(const std::uint32_t* __restrict__ bits, GridShape shape, std::uint32_t* __restrict__ contour,
                   std::uint32_t* __restrict__ cells) {
  const unsigned i = thread_in_grid();
  if (i >= shape.word_count() / kCell) return;
  const CellRow r = cell_row(shape, i);
  const std::uint32_t plane = std::uint32_t(shape.words) * std::uint32_t(shape.ny);
  const auto row = [&](int y) { return y >= 0 && y < shape.ny ? bits[shape.word(r.w, y, r.z)] : 0u; };
  std::uint32_t any = 0, below = row(r.cy * kCell - 1), here = row(r.cy * kCell);
#pragma unroll
  for (int j = 0; j < kCell; ++j) {
    const int y = r.cy * kCell + j;
    const std::uint32_t above = row(y + 1), at = shape.word(r.w, y, r.z);
    const std::uint32_t left = r.w > 0 ? bits[at - 1] : 0, right = r.w + 1 < shape.words ? bits[at + 1] : 0;
    const std::uint32_t back = r.z > 0 ? bits[at - plane] : 0, front = r.z + 1 < shape.nz ? bits[at + plane] : 0;
    const std::uint32_t beside = (here << 1 | left >> 31) | (here >> 1 | right << 31);
    const std::uint32_t c = ~here & (beside | below | above | back | front);
    contour[at] = c;
    any |= c;
    below = here;
    here = above;
  }
  if (any) atomicOr(&cells[shape.quad(r.w, r.cy, r.z / kCell)], spread_bytes(any));
}

}  // namespace

void pack_bits(const std::uint32_t* from, const BoxOfWords& box, const GridShape& shape, std::uint32_t* bits,
               std::uint32_t* cells, cudaStream_t stream) {
  launch("pack_kernel", pack_kernel, blocks_for(cell_rows(shape)), kPassThreads, 0, stream, from, box, shape, bits,
         cells);
}

void unpack_bits(const std::uint32_t* bits, const GridShape& shape, const BoxOfWords& box, const VoxelRange& keep,
                 std::uint32_t* to, cudaStream_t stream) {
  const std::uint64_t n = std::uint64_t(box.words) * std::uint64_t(box.ny) * std::uint64_t(box.nz);
  const unsigned blocks = blocks_for(n < (std::uint64_t(1) << 24) ? n : std::uint64_t(1) << 24);
  launch("unpack_kernel", unpack_kernel, blocks, kPassThreads, 0, stream, bits, shape, box, keep, to);
}

void window_table(const std::uint32_t* bits, const GridShape& shape, int length, std::uint32_t* half,
                  std::uint32_t* table, cudaStream_t stream) {
  const std::uint32_t words = std::uint32_t(shape.words), ny = std::uint32_t(shape.ny), nz = std::uint32_t(shape.nz);
  window_pass(bits, half, {words, ny, words, words * ny, 0}, words * nz, length, stream);
  window_pass(half, table, {words * ny, nz, words * ny, 0, 0}, words * ny, length, stream);
}

void dilate_cube(const std::uint32_t* table, int length, const std::uint32_t* bits, const GridShape& shape,
                 const VoxelRange& region, const ScaleView& scale, bool first, std::uint32_t* out,
                 cudaStream_t stream) {
  if (scale.samples == nullptr) {
    launch("dilate_cube_kernel", dilate_cube_kernel, blocks_for(shape.word_count()), kPassThreads, 0, stream, table,
           length, shape, region, int(scale.constant) / kScaleOne, out);
  } else {
    launch("dilate_cube_varying_kernel", dilate_cube_varying_kernel, blocks_for(shape.word_count()), kPassThreads, 0,
           stream, table, length, bits, shape, region, scale, first, out);
  }
}

void outer_contour(const std::uint32_t* bits, const GridShape& shape, std::uint32_t* contour, std::uint32_t* cells,
                   cudaStream_t stream) {
  launch("contour_kernel", contour_kernel, blocks_for(cell_rows(shape)), kPassThreads, 0, stream, bits, shape, contour,
         cells);
}

}  // namespace bp
