// A warp has 8 x 8 words of 32 voxels that share a rotation. It asks for blocks of rows of the turned cube: what all
// rows of a block have in common meets G, then the voxel is in; what any of them has does not, then none of them is
// asked. Else the block is taken apart. A stretch of x of any length is two windows, each a power of two wide, that are
// read from tables. So rows are asked one by one only where G ends near the cube's own face.
#include "gpu/kernels/launch.h"
#include "gpu/kernels/turned_kernels.h"

namespace bp {

namespace {

// ---------------------------------------------------------------- tables

/// Words of one table by number: y fastest, then w, then z.
struct Column {
  int y, w, z;
};
__device__ Column column_at(const GridShape& s, std::uint32_t i) {
  const std::uint32_t rest = i / std::uint32_t(s.ny);
  return {int(i - rest * std::uint32_t(s.ny)), int(rest % std::uint32_t(s.words)), int(rest / std::uint32_t(s.words))};
}

__global__ void __launch_bounds__(kPassThreads)
    columns_kernel(const std::uint32_t* __restrict__ bits, GridShape shape, std::uint32_t* __restrict__ to) {
  const std::uint32_t i = thread_in_grid();
  if (i >= shape.word_count()) return;
  const Column c = column_at(shape, i);
  to[i] = bits[shape.word(c.w, c.y, c.z)];
}

/// Windows of twice the length along x, from those of `shift`.
__global__ void __launch_bounds__(kPassThreads)
    double_along_kernel(const std::uint32_t* __restrict__ from, GridShape shape, int shift,
                        std::uint32_t* __restrict__ to) {
  const std::uint32_t i = thread_in_grid();
  if (i >= shape.word_count()) return;
  const int w = column_at(shape, i).w + shift / 32;
  const std::uint32_t at = i + std::uint32_t(shift / 32) * std::uint32_t(shape.ny);
  const std::uint32_t near = w < shape.words ? from[at] : 0,
                      far = w + 1 < shape.words ? from[at + std::uint32_t(shape.ny)] : 0;
  to[i] = from[i] | __funnelshift_r(near, far, unsigned(shift) & 31);
}

/// Windows of four times as many rows across, from those of `rows`.
__global__ void __launch_bounds__(kPassThreads)
    widen_across_kernel(const std::uint32_t* __restrict__ from, GridShape shape, int rows,
                        std::uint32_t* __restrict__ to) {
  const std::uint32_t i = thread_in_grid();
  if (i >= shape.word_count()) return;
  const Column c = column_at(shape, i);
  const std::uint32_t plane = std::uint32_t(shape.words) * std::uint32_t(shape.ny);
  std::uint32_t sum = 0;
#pragma unroll
  for (int k = 0; k < 4; ++k) {
#pragma unroll
    for (int j = 0; j < 4; ++j) {
      if (c.y + j * rows < shape.ny && c.z + k * rows < shape.nz)
        sum |= from[i + std::uint32_t(j * rows) + std::uint32_t(k * rows) * plane];
    }
  }
  to[i] = sum;
}

// ---------------------------------------------------------------- what is asked

/// Work of one warp: the quad of cells, and which of its four cells, whose cubes are alike.
__device__ std::uint32_t item_of(std::uint32_t quad, unsigned cells) {
  return quad << 4 | cells;
}
/// A cell's 8 voxels of a word, for each cell of the four.
__device__ std::uint32_t voxels_of_cells(unsigned cells) {
  return (cells & 1 ? 0xffu : 0u) | (cells & 2 ? 0xff00u : 0u) | (cells & 4 ? 0xff0000u : 0u) |
         (cells & 8 ? 0xff000000u : 0u);
}

/// Bounds of S over a cell.
struct CellScale {
  int least, most;
  __device__ CellScale(const ScaleView& s, int cx, int cy, int cz) : least(s.constant), most(s.constant) {
    if (s.samples == nullptr) return;
    least = 0xffff, most = 0;
    for (int c = 0; c < 8; ++c) {
      const int v = int(s.sample(cx + (c & 1), cy + (c >> 1 & 1), cz + (c >> 2)));
      least = min(least, v), most = max(most, v);
    }
  }
};

/// The 64 words of a quad, two to a lane: (y, z) and (y, z + 4).
struct LaneWords {
  int w, y, z;
  __device__ LaneWords(const GridShape& shape, std::uint32_t quad) {
    const QuadCoord q = quad_at(shape, quad);
    w = q.w, y = kCell * q.cy + (lane_id() & 7), z = kCell * q.cz + (lane_id() >> 3);
  }
};

/// Lists the quads with open voxels, each once for all of its cells that are alike.
__global__ void __launch_bounds__(kPassThreads) list_turned_kernel(const __grid_constant__ TurnedArgs a) {
  const std::uint32_t quad = thread_in_grid() / kWarp;
  if (quad >= a.shape.quad_count()) return;
  const LaneWords at(a.shape, quad);
  std::uint32_t open = 0;
#pragma unroll
  for (int h = 0; h < 2; ++h) {
    const std::uint32_t i = a.shape.word(at.w, at.y, at.z + 4 * h);
    open |= a.open[i] & ~a.out[i];
  }
  unsigned cells = 0;
#pragma unroll
  for (int c = 0; c < 4; ++c) cells |= __any_sync(kAllLanes, (open >> (8 * c) & 255) != 0) ? 1u << c : 0u;
  if (cells == 0) return;
  const int own = lane_id() & 3, cy = at.y / kCell, cz = at.z / kCell;
  const CellScale scale(a.scale, 4 * at.w + own, cy, cz);
  const std::uint64_t key =
      std::uint64_t(a.cubes.at(4 * at.w + own, cy, cz)) << 32 | unsigned(scale.least) << 16 | unsigned(scale.most);
  unsigned alike = 0;
#pragma unroll
  for (int c = 0; c < 4; ++c) {
    const std::uint64_t other = __shfl_sync(kAllLanes, key, c);
    if ((cells >> c & 1) && other == key) alike |= 1u << c;
  }
  const bool first = lane_id() < 4 && (cells >> own & 1) && (alike & ((1u << own) - 1)) == 0;
  append(first, item_of(quad, alike), a.items, &a.counts[0]);
}

// ---------------------------------------------------------------- the cube

/// Voxels of a row: none if hi < lo.
struct Stretch {
  int lo, hi;
  __device__ bool empty() const { return hi < lo; }
};

struct TurnedCube {
  Rotation rotation;  ///< canonical: no row begins with a negative number
  int least, most;    ///< S; what lies between is for each voxel to say
  int reach;

  __device__ static int limit(int s) { return s * ((1 << kRotationBits) / kScaleOne); }

  /// The x that lie in the cube for all, or for any, of `rows` x `rows` rows from (y, z) on; for `any`, some more.
  template <bool kAll>
  __device__ Stretch stretch(int scale, int y, int z, int rows) const {
    Stretch s{-reach, reach};
#pragma unroll
    for (int i = 0; i < 3; ++i) {  // |a x + t| <= limit
      const int a = rotation.row[i][0], b = rotation.row[i][1], c = rotation.row[i][2];
      const int t = b * y + c * z, low = t + (min(b, 0) + min(c, 0)) * (rows - 1),
                high = t + (max(b, 0) + max(c, 0)) * (rows - 1);
      const int first = -limit(scale) - (kAll ? low : high), last = limit(scale) - (kAll ? high : low);
      if (a == 0) {
        if (first > 0 || last < 0) s.hi = -reach - 1;
      } else {
        s.lo = max(s.lo, ceil_div(first, a));
        s.hi = min(s.hi, floor_div(last, a));
      }
    }
    return s;
  }
};

/// A warp and its words.
struct Asker {
  const TurnedArgs& a;
  TurnedCube cube;
  LaneWords at;
  std::uint32_t column;  ///< number of the lane's first word in a table
  std::uint32_t open[2];

  __device__ bool any_open() const { return __any_sync(kAllLanes, (open[0] | open[1]) != 0); }

  /// Voxels from which a voxel of the rows from (dy, dz) on meets G.
  __device__ void meet(int level, Stretch s, int dy, int dz, std::uint32_t (&met)[2]) const {
    met[0] = met[1] = 0;
    const int k = max(31 - __clz(s.hi - s.lo + 1), first_octave(level)), ny = a.shape.ny;
    const std::uint32_t* table = a.tables.table[level][k];
    const std::uint32_t four = 4u * std::uint32_t(a.shape.words) * std::uint32_t(ny);
    const std::uint32_t row = column + std::uint32_t(dz * a.shape.words * ny + dy);
#pragma unroll
    for (int i = 0; i < 2; ++i) {
      const int start = i == 0 ? s.lo : max(s.lo, s.hi + 1 - (1 << k)), w = at.w + (start >> 5);
      const std::uint32_t from = row + std::uint32_t((start >> 5) * ny);
      const bool near = w >= 0 && w < a.shape.words, far = w + 1 >= 0 && w + 1 < a.shape.words;
#pragma unroll
      for (int h = 0; h < 2; ++h) {
        if (open[h] == 0) continue;
        met[h] |= __funnelshift_r(near ? table[from + h * four] : 0,
                                  far ? table[from + h * four + std::uint32_t(ny)] : 0, unsigned(start) & 31);
      }
    }
  }

  /// Of these voxels of a lane's word, those whose own cube has something of row (dy, dz).
  __device__ std::uint32_t decide(std::uint32_t voxels, int half, int dy, int dz) const {
    std::uint32_t met = 0;
    for (; voxels != 0; voxels &= voxels - 1) {
      const int x = __ffs(int(voxels)) - 1;
      const Stretch s = cube.stretch<true>(a.scale.at(32 * at.w + x, at.y, at.z + 4 * half), dy, dz, 1);
      if (s.empty()) continue;
      const int k = 31 - __clz(s.hi - s.lo + 1);
      const std::uint32_t row = column + std::uint32_t((dz + 4 * half) * a.shape.words * a.shape.ny + dy);
      for (const int start : {s.lo + x, s.hi + 1 - (1 << k) + x}) {
        const int w = at.w + (start >> 5);
        if (w >= 0 && w < a.shape.words &&
            (a.tables.table[0][k][row + std::uint32_t((start >> 5) * a.shape.ny)] >> (start & 31) & 1))
          met |= 1u << x;
      }
    }
    return met;
  }

  /// Asks for across^2 blocks of rows of a level, the first of which begins at (y0, z0).
  template <int kLevel>
  __device__ void ask(int y0, int z0, int across) {
    constexpr int kRows = rows_across(kLevel), kShortest = 1 << first_octave(kLevel);
    for (int first = 0; first < across * across; first += kWarp) {
      const int dy = y0 + (first + lane_id()) % across * kRows, dz = z0 + (first + lane_id()) / across * kRows;
      const bool inside = first + lane_id() < across * across && dy <= cube.reach && dz <= cube.reach;
      const bool settles = kLevel == 0 && cube.least == cube.most;
      const Stretch all = cube.stretch<true>(cube.least, dy, dz, kRows),
                    some = settles ? all : cube.stretch<false>(cube.most, dy, dz, kRows);
      std::uint32_t met[2];
      for (unsigned left = __ballot_sync(kAllLanes, inside && all.hi - all.lo + 1 >= kShortest); left != 0;
           left &= left - 1) {
        const int i = __ffs(int(left)) - 1;
        meet(kLevel, {__shfl_sync(kAllLanes, all.lo, i), __shfl_sync(kAllLanes, all.hi, i)},
             __shfl_sync(kAllLanes, dy, i), __shfl_sync(kAllLanes, dz, i), met);
        open[0] &= ~met[0], open[1] &= ~met[1];
      }
      if (!any_open()) return;
      if (settles) continue;
      for (unsigned left = __ballot_sync(kAllLanes, inside && !some.empty()); left != 0; left &= left - 1) {
        const int i = __ffs(int(left)) - 1, y = __shfl_sync(kAllLanes, dy, i), z = __shfl_sync(kAllLanes, dz, i);
        meet(kLevel, {__shfl_sync(kAllLanes, some.lo, i), __shfl_sync(kAllLanes, some.hi, i)}, y, z, met);
        met[0] &= open[0], met[1] &= open[1];
        if constexpr (kLevel == 0) {
          open[0] &= ~decide(met[0], 0, y, z), open[1] &= ~decide(met[1], 1, y, z);
        } else {
          if (__any_sync(kAllLanes, (met[0] | met[1]) != 0)) ask<kLevel - 1>(y, z, 4);
        }
      }
    }
  }
};

/// Blocks of the next kernel on a multiprocessor.
constexpr int kTurnedBlocks = 4;

__global__ void __launch_bounds__(kPassThreads, kTurnedBlocks)
    dilate_turned_kernel(const __grid_constant__ TurnedArgs a) {
  const unsigned count = a.counts[0];
  for (unsigned item = next_item(&a.counts[1]); item < count; item = next_item(&a.counts[1])) {
    const std::uint32_t quad = a.items[item] >> 4;
    const unsigned cells = a.items[item] & 15;
    const LaneWords at(a.shape, quad);
    const int cx = 4 * at.w + __ffs(int(cells)) - 1, cy = at.y / kCell, cz = at.z / kCell;
    const CellScale scale(a.scale, cx, cy, cz);
    const Rotation rotation = a.cubes.rotations[a.cubes.at(cx, cy, cz)];
    const int reach = cube_bounds(rotation).reach(Scale(scale.most));
    const std::uint32_t column =
        (std::uint32_t(at.z) * std::uint32_t(a.shape.words) + std::uint32_t(at.w)) * std::uint32_t(a.shape.ny) +
        std::uint32_t(at.y);
    Asker asker{a, {rotation, scale.least, scale.most, reach}, at, column, {}};
    std::uint32_t asked[2];
#pragma unroll
    for (int h = 0; h < 2; ++h) {
      const std::uint32_t i = a.shape.word(at.w, at.y, at.z + 4 * h);
      asker.open[h] = asked[h] = a.open[i] & ~a.out[i] & voxels_of_cells(cells);
    }
    constexpr int kTop = kTurnedLevels - 1, kRows = rows_across(kTop);
    asker.ask<kTop>(-reach, -reach, (2 * reach + kRows) / kRows);
#pragma unroll
    for (int h = 0; h < 2; ++h) {
      const std::uint32_t met = asked[h] & ~asker.open[h];
      if (met != 0) atomicOr(&a.out[a.shape.word(at.w, at.y, at.z + 4 * h)], met);
    }
  }
}

int last_octave(int longest) {
  int k = first_octave(kTurnedLevels - 1);
  while ((2 << k) <= longest) ++k;
  return k;
}

}  // namespace

int turned_table_count(int longest) {
  int count = 0;
  for (int level = 0; level < kTurnedLevels; ++level) count += last_octave(longest) - first_octave(level) + 1;
  return count;
}

TurnedTables turned_tables(const std::uint32_t* bits, const GridShape& shape, int longest, std::uint32_t* memory,
                           cudaStream_t stream) {
  const std::size_t words = shape.word_count();
  const unsigned blocks = blocks_for(words);
  TurnedTables tables;
  tables.last = last_octave(longest);
  for (int level = 0; level < kTurnedLevels; ++level) {
    for (int k = first_octave(level); k <= tables.last; ++k, memory += words) {
      tables.table[level][k] = memory;
      if (level > 0) {
        launch("widen_across_kernel", widen_across_kernel, blocks, kPassThreads, 0, stream, tables.table[level - 1][k],
               shape, rows_across(level - 1), memory);
      } else if (k > 0) {
        launch("double_along_kernel", double_along_kernel, blocks, kPassThreads, 0, stream, tables.table[0][k - 1],
               shape, 1 << (k - 1), memory);
      } else {
        launch("columns_kernel", columns_kernel, blocks, kPassThreads, 0, stream, bits, shape, memory);
      }
    }
  }
  return tables;
}

void dilate_turned(const TurnedArgs& args, int multiprocessors, cudaStream_t stream) {
  launch("list_turned_kernel", list_turned_kernel, blocks_for(std::uint64_t(args.shape.quad_count()) * kWarp),
         kPassThreads, 0, stream, args);
  launch("dilate_turned_kernel", dilate_turned_kernel, unsigned(multiprocessors) * kTurnedBlocks, kPassThreads, 0,
         stream, args);
}

}  // namespace bp
