// Cube dilation. If the radius is constant, it is a windowed OR in y and z, then a widening of words in x. The OR uses
// a table of power-of-two windows, with two overlapping look-ups per axis, as in a sparse table of range maxima. If the
// radius varies, one table answers every radius of its octave, so a word asks only for the radii that occur in it.
#include "gpu/kernels/bit_kernels.h"
#include "gpu/kernels/launch.h"
#include "lib/grid/brick.h"

namespace bp {

namespace {

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
    pack_bricks_kernel(const __grid_constant__ BrickTable from, GridShape shape, std::uint32_t* __restrict__ bits,
                       std::uint32_t* __restrict__ cells) {
  const unsigned i = thread_in_grid();
  if (i >= shape.word_count() / kCell) return;
  const CellRow r = cell_row(shape, i);
  const int w = r.w - from.w0, y = r.cy * kCell - from.y0, z = r.z - from.z0;  // a cell never straddles bricks
  const bool inside =
      w >= 0 && w < 2 * from.nx && y >= 0 && y < kBrickEdge * from.ny && z >= 0 && z < kBrickEdge * from.nz;
  std::uint32_t slot = kEmptyBrick;
  if (inside) slot = from.slots[(z / kBrickEdge * from.ny + y / kBrickEdge) * from.nx + w / 2];
  const std::uint64_t* rows =
      slot < kFullBrick ? from.bits + std::size_t(slot) * kBrickWords + z % kBrickEdge * kBrickEdge + y % kBrickEdge
                        : nullptr;
  std::uint32_t any = 0;
#pragma unroll
  for (int j = 0; j < kCell; ++j) {
    std::uint32_t v = slot == kFullBrick ? ~0u : 0u;
    if (rows != nullptr) v = std::uint32_t(rows[j] >> (w % 2 * 32));
    bits[shape.word(r.w, r.cy * kCell + j, r.z)] = v;
    any |= v;
  }
  if (any) atomicOr(&cells[shape.quad(r.w, r.cy, r.z / kCell)], spread_bytes(any));
}

/// One block per brick.
__global__ void __launch_bounds__(kPassThreads)
    unpack_bricks_kernel(const std::uint32_t* __restrict__ bits, GridShape shape, const __grid_constant__ BrickTable to,
                         std::uint32_t* count) {
  constexpr int kOwn = int(kBrickWords) / kPassThreads;
  std::uint32_t* shared_slot = static_cast<std::uint32_t*>(dynamic_shared_memory());
  const int bx = int(blockIdx.x) % to.nx, by = int(blockIdx.x) / to.nx % to.ny, bz = int(blockIdx.x) / to.nx / to.ny;
  std::uint64_t own[kOwn], any = 0, all = ~std::uint64_t(0);
#pragma unroll
  for (int k = 0; k < kOwn; ++k) {
    const int row = int(threadIdx.x) + k * kPassThreads;
    const std::uint32_t at = shape.word(to.w0 + 2 * bx, to.y0 + kBrickEdge * by + row % kBrickEdge,
                                        to.z0 + kBrickEdge * bz + row / kBrickEdge);
    own[k] = bits[at] | std::uint64_t(bits[at + 1]) << 32;
    any |= own[k], all &= own[k];
  }
  const bool some = __syncthreads_or(any != 0) != 0, full = __syncthreads_and(all == ~std::uint64_t(0)) != 0;
  if (threadIdx.x == 0) {
    const std::uint32_t slot = full ? kFullBrick : some ? atomicAdd(count, 1u) : kEmptyBrick;
    to.slots[blockIdx.x] = slot;
    *shared_slot = slot;
  }
  if (full || !some) return;
  __syncthreads();
  std::uint64_t* out = to.bits + std::size_t(*shared_slot) * kBrickWords;
#pragma unroll
  for (int k = 0; k < kOwn; ++k) out[int(threadIdx.x) + k * kPassThreads] = own[k];
}

__global__ void __launch_bounds__(kPassThreads)
    unpack_kernel(const std::uint32_t* __restrict__ bits, GridShape shape, BoxOfWords box, VoxelRange keep,
                  std::uint32_t* __restrict__ to) {
  const unsigned words = unsigned(box.words), ny = unsigned(box.ny), n = words * ny * unsigned(box.nz);
  const unsigned i = thread_in_grid();
  if (i >= n) return;
  const unsigned row = i / words;
  const int w = int(i - row * words) + box.w0, y = int(row % ny) + box.y0, z = int(row / ny) + box.z0;
  const bool inside = w >= 0 && w < shape.words && y >= 0 && y < shape.ny && z >= 0 && z < shape.nz;
  to[i] = inside ? bits[shape.word(w, y, z)] & keep.mask(w, y, z) : 0;
}

/// One axis of a windowed OR, as runs of `n` words `stride` apart.
struct WindowAxis {
  std::uint32_t stride, n, inner, outer_stride, runs;  ///< runs: chunks of kRun outputs along the axis
};

/// out[j] = OR of in[j] to in[j + length - 1], kRun consecutive j per thread. The part that all of them share is read
/// and joined once; the two ragged ends are running ORs. That takes (length + kRun - 1) / kRun reads per output.
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

/// Returns the voxels of a word within r of a set voxel of the same word.
__device__ std::uint32_t widen(std::uint32_t v, int r) {
  for (int reach = 0;
       reach < r && reach < 31;) {  // a step is reach + 1 at most: else a run cut at the word's end would tear
    const int step = min(reach + 1, r - reach);
    v |= v << step | v >> step;
    reach += step;
  }
  return v;
}

/// The windows of radius r around rows y of slice z: four windows of the radius' table cover each.
struct Windows {
  const std::uint32_t *low, *high;  ///< the two slices of the table
  int r, length, words;
  __device__ Windows(const WindowTables& tables, const GridShape& s, int radius, int z) : r(radius), words(s.words) {
    const int octave = 31 - __clz(2 * radius + 1);  // octave_of
    length = 1 << octave;
    const std::size_t plane = std::size_t(s.words) * std::size_t(s.ny);
    low = tables.table[octave] + std::size_t(max(z - r, 0)) * plane;
    high = tables.table[octave] + std::size_t(max(z + r + 1 - length, 0)) * plane;
  }
  /// Returns false if no voxel of word w in rows y .. y + rows - 1 can have G in its cube.
  __device__ bool any_near(int w, int y, int rows) const {
    const int side = (r + 31) / 32, first = max(w - side, 0), last = min(w + side, words - 1);
    const int end = y + rows + r - length;  // where the last window begins
    std::uint32_t found = 0;
    for (int at = max(y - r, 0);; at = min(at + length, end)) {
      for (int k = first; k <= last; ++k) found |= low[at * words + k] | high[at * words + k];
      if (found != 0 || at >= end) return found != 0;
    }
  }
  /// Returns the voxels of word w of row y whose cube of radius r meets G.
  __device__ std::uint32_t word(int w, int y) const {
    const int a = max(y - r, 0) * words + w, b = max(y + r + 1 - length, 0) * words + w;
    const std::uint32_t centre = any(a, b), right = w + 1 < words ? any(a + 1, b + 1) : 0,
                        left = w > 0 ? any(a - 1, b - 1) : 0;
    if (r == 0) return centre;
    std::uint32_t out = 0;
    if (centre != 0) out = centre == ~0u ? centre : widen(centre, r);
    if (right != 0) {
      out |= reached_from_right(31 + __ffs(int(right)));
    } else {
      for (int k = 2; 32 * (k - 1) < r && w + k < words; ++k) {
        const std::uint32_t v = any(a + k, b + k);
        if (v == 0) continue;
        out |= reached_from_right(32 * k + __ffs(int(v)) - 1);
        break;
      }
    }
    if (left != 0) {
      out |= reached_from_left(1 + __clz(int(left)));
    } else {
      for (int k = 2; 32 * (k - 1) < r && w - k >= 0; ++k) {
        const std::uint32_t v = any(a - k, b - k);
        if (v == 0) continue;
        out |= reached_from_left(32 * (k - 1) + 1 + __clz(int(v)));
        break;
      }
    }
    return out;
  }

 private:
  __device__ std::uint32_t any(int a, int b) const { return low[a] | low[b] | high[a] | high[b]; }
  /// Return the voxels within r of a set voxel `at` >= 32 voxels from the word's first, or `before` > 0 voxels before
  /// it.
  __device__ std::uint32_t reached_from_right(int at) const { return at - r < 32 ? ~0u << max(at - r, 0) : 0; }
  __device__ std::uint32_t reached_from_left(int before) const {
    return r >= before ? ~0u >> max(31 - (r - before), 0) : 0;
  }
};

__global__ void __launch_bounds__(kPassThreads)
    dilate_cube_kernel(const __grid_constant__ WindowTables tables, GridShape shape, VoxelRange region, int r,
                       std::uint32_t* __restrict__ out) {
  const unsigned i = thread_in_grid();
  if (i >= shape.word_count() / kCell) return;
  const CellRow c = cell_row(shape, i);
  const Windows windows(tables, shape, r, c.z);
  const bool any = windows.any_near(c.w, kCell * c.cy, kCell);
  for (int y = kCell * c.cy; y < kCell * (c.cy + 1); ++y) {
    const std::uint32_t mask = any ? region.mask(c.w, y, c.z) : 0;
    out[shape.word(c.w, y, c.z)] = mask ? windows.word(c.w, y) & mask : 0;
  }
}

/// Makes the table of windows of 2 `length` from that of `length`.
__global__ void __launch_bounds__(kPassThreads)
    double_windows_kernel(const std::uint32_t* __restrict__ in, GridShape shape, int length,
                          std::uint32_t* __restrict__ out) {
  const unsigned i = thread_in_grid();
  if (i >= shape.word_count() / kCell) return;
  const CellRow c = cell_row(shape, i);
  const std::uint32_t across = std::uint32_t(length) * std::uint32_t(shape.words),
                      deep = across * std::uint32_t(shape.ny);
  const bool behind = c.z + length < shape.nz;
#pragma unroll
  for (int j = 0; j < kCell; ++j) {
    const int y = kCell * c.cy + j;
    const std::uint32_t at = shape.word(c.w, y, c.z);
    const bool beside = y + length < shape.ny;
    std::uint32_t v = in[at];
    if (beside) v |= in[at + across];
    if (behind) v |= in[at + deep];
    if (beside && behind) v |= in[at + across + deep];
    out[at] = v;
  }
}

/// Words by number, in any order.
struct WordList {
  std::uint32_t *words, *count;
};

/// The scale along one word: 64 S at its five lattice corners, so that S is linear in between.
struct WordScale {
  std::uint32_t corner[5];
  __device__ WordScale(const ScaleView& s, int w, int y, int z) {
#pragma unroll
    for (int i = 0; i < 5; ++i) corner[i] = s.column(4 * w + i, y, z);
  }
  /// Bounds r over the word. The last corner belongs to the next word, so the bound need not be attained.
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
  /// Returns the voxels with r >= radius: 512 S is a sum that grows by the same amount from voxel to voxel within a
  /// cell.
  __device__ std::uint32_t at_least(int radius) const {
    const std::int32_t bound = radius * kScaleOne * 512;
    std::uint32_t bits = 0;
#pragma unroll
    for (int c = 0; c < 4; ++c) {
      std::int32_t sum = std::int32_t(corner[c]) * 8;
      const std::int32_t slope = std::int32_t(corner[c + 1]) - std::int32_t(corner[c]), last = sum + 7 * slope;
      if (min(sum, last) >= bound) {
        bits |= 0xffu << (8 * c);
      } else if (max(sum, last) >= bound) {
#pragma unroll
        for (int i = 0; i < 8; ++i) {
          bits |= sum >= bound ? 1u << (8 * c + i) : 0u;
          sum += slope;
        }
      }
    }
    return bits;
  }
};

/// First pass of a varying dilation: settles the words that the largest radius does not reach or that G fills, and
/// lists the others.
__global__ void __launch_bounds__(kPassThreads)
    dilate_cube_far_kernel(const __grid_constant__ WindowTables tables, const std::uint32_t* __restrict__ bits,
                           GridShape shape, VoxelRange region, int most, std::uint32_t* __restrict__ out,
                           WordList list) {
  std::uint32_t* shared =
      static_cast<std::uint32_t*>(dynamic_shared_memory());  // words of each warp, then the place of the first
  const unsigned i = thread_in_grid();
  std::uint32_t open = 0;  // rows that are listed
  CellRow c{};
  if (i < shape.word_count() / kCell) {
    c = cell_row(shape, i);
    const bool any = Windows(tables, shape, most, c.z).any_near(c.w, kCell * c.cy, kCell);
#pragma unroll
    for (int j = 0; j < kCell; ++j) {
      const int y = kCell * c.cy + j;
      const std::uint32_t mask = region.mask(c.w, y, c.z), at = shape.word(c.w, y, c.z), have = bits[at] & mask;
      out[at] = have;
      if (any && have != mask) open |= 1u << j;
    }
  }
  std::uint32_t rows[kCell], before = 0;
#pragma unroll
  for (int j = 0; j < kCell; ++j) {
    rows[j] = __ballot_sync(kAllLanes, open >> j & 1);
    before += unsigned(__popc(rows[j]));
  }
  if (lane_id() == 0) shared[warp_in_block()] = before;
  __syncthreads();
  if (threadIdx.x == 0) {
    std::uint32_t sum = 0;
    for (unsigned k = 0; k < blockDim.x / kWarp; ++k) {
      const std::uint32_t own = shared[k];
      shared[k] = sum;
      sum += own;
    }
    const std::uint32_t first = sum != 0 ? atomicAdd(list.count, sum) : 0;
    for (unsigned k = 0; k < blockDim.x / kWarp; ++k) shared[k] += first;
  }
  __syncthreads();
  std::uint32_t place = shared[warp_in_block()];
#pragma unroll
  for (int j = 0; j < kCell; ++j) {
    if (open >> j & 1)
      list.words[place + unsigned(__popc(rows[j] & ((1u << lane_id()) - 1)))] = shape.word(c.w, kCell * c.cy + j, c.z);
    place += unsigned(__popc(rows[j]));
  }
}

/// Least number of blocks of the next kernel on a multiprocessor.
constexpr int kListedBlocks = 3;
/// Settles the listed words: by the least and the largest radius of the word if they agree, else radius by radius.
__global__ void __launch_bounds__(kPassThreads, kListedBlocks)
    dilate_cube_listed_kernel(const __grid_constant__ WindowTables tables, GridShape shape, VoxelRange region,
                              const __grid_constant__ ScaleView scale, std::uint32_t* __restrict__ out, WordList list) {
  const unsigned count = *list.count;
  for (unsigned i = thread_in_grid(); i < count; i += gridDim.x * blockDim.x) {
    const std::uint32_t at = list.words[i], row = at / unsigned(shape.words), have = out[at];
    const int w = int(at - row * unsigned(shape.words)), y = int(row % unsigned(shape.ny)),
              z = int(row / unsigned(shape.ny));
    const WordScale s(scale, w, y, z);
    const int least = s.least(), most = s.most();
    const std::uint32_t open = Windows(tables, shape, most, z).word(w, y) & region.mask(w, y, z) & ~have;
    std::uint32_t reached = 0;
    if (open != 0 && least > 0) reached = open & Windows(tables, shape, least, z).word(w, y);
    for (int r = least + 1; r <= most && (open & ~reached) != 0; ++r) {
      const std::uint32_t asked = open & ~reached & s.at_least(r);
      if (asked == 0) break;  // no larger radius occurs either
      reached |= r == most ? asked : asked & Windows(tables, shape, r, z).word(w, y);
    }
    if (reached != 0) out[at] = have | reached;
  }
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

cudaError_t find_code() {
  cudaFuncAttributes attributes{};
  return cudaFuncGetAttributes(&attributes, contour_kernel);
}

void pack_bits(const std::uint32_t* from, const BoxOfWords& box, const GridShape& shape, std::uint32_t* bits,
               std::uint32_t* cells, cudaStream_t stream) {
  launch("pack_kernel", pack_kernel, blocks_for(cell_rows(shape)), kPassThreads, 0, stream, from, box, shape, bits,
         cells);
}

void pack_bricks(const BrickTable& from, const GridShape& shape, std::uint32_t* bits, std::uint32_t* cells,
                 cudaStream_t stream) {
  launch("pack_bricks_kernel", pack_bricks_kernel, blocks_for(cell_rows(shape)), kPassThreads, 0, stream, from, shape,
         bits, cells);
}

void unpack_bricks(const std::uint32_t* bits, const GridShape& shape, const BrickTable& to, std::uint32_t* count,
                   cudaStream_t stream) {
  launch("unpack_bricks_kernel", unpack_bricks_kernel, unsigned(to.nx * to.ny * to.nz), kPassThreads,
         sizeof(std::uint32_t), stream, bits, shape, to, count);
}

void unpack_bits(const std::uint32_t* bits, const GridShape& shape, const BoxOfWords& box, const VoxelRange& keep,
                 std::uint32_t* to, cudaStream_t stream) {
  const unsigned n = unsigned(box.words) * unsigned(box.ny) * unsigned(box.nz);
  launch("unpack_kernel", unpack_kernel, blocks_for(n), kPassThreads, 0, stream, bits, shape, box, keep, to);
}

void window_table(const std::uint32_t* bits, const GridShape& shape, int length, std::uint32_t* half,
                  std::uint32_t* table, cudaStream_t stream) {
  const std::uint32_t words = std::uint32_t(shape.words), ny = std::uint32_t(shape.ny), nz = std::uint32_t(shape.nz);
  window_pass(bits, half, {words, ny, words, words * ny, 0}, words * nz, length, stream);
  window_pass(half, table, {words * ny, nz, words * ny, 0, 0}, words * ny, length, stream);
}

void double_windows(const std::uint32_t* table, const GridShape& shape, int length, std::uint32_t* twice,
                    cudaStream_t stream) {
  launch("double_windows_kernel", double_windows_kernel, blocks_for(cell_rows(shape)), kPassThreads, 0, stream, table,
         shape, length, twice);
}

void dilate_cube(const WindowTables& tables, const GridShape& shape, const VoxelRange& region, int radius,
                 std::uint32_t* out, cudaStream_t stream) {
  launch("dilate_cube_kernel", dilate_cube_kernel, blocks_for(cell_rows(shape)), kPassThreads, 0, stream, tables, shape,
         region, radius, out);
}

void dilate_cube_varying(const WindowTables& tables, const std::uint32_t* bits, const GridShape& shape,
                         const VoxelRange& region, const ScaleView& scale, int most, int multiprocessors,
                         std::uint32_t* out, std::uint32_t* words, std::uint32_t* count, cudaStream_t stream) {
  const WordList list{words, count};
  launch("dilate_cube_far_kernel", dilate_cube_far_kernel, blocks_for(cell_rows(shape)), kPassThreads,
         kPassThreads / kWarp * sizeof(std::uint32_t), stream, tables, bits, shape, region, most, out, list);
  launch("dilate_cube_listed_kernel", dilate_cube_listed_kernel, unsigned(multiprocessors) * 2 * kListedBlocks,
         kPassThreads, 0, stream, tables, shape, region, scale, out, list);
}

void outer_contour(const std::uint32_t* bits, const GridShape& shape, std::uint32_t* contour, std::uint32_t* cells,
                   cudaStream_t stream) {
  launch("contour_kernel", contour_kernel, blocks_for(cell_rows(shape)), kPassThreads, 0, stream, bits, shape, contour,
         cells);
}

}  // namespace bp
