// A warp has 8 x 8 words of 32 voxels that share a rotation. It asks for blocks of rows of the turned cube. If nothing
// in any row of a block meets G, none of its rows is asked for; else the block is taken apart. A stretch of x of any
// length is two windows, each a power of two wide, which are read from tables. So rows are asked for one by one only
// where G ends near the cube's own face.
#include "gpu/kernels/launch.h"
#include "gpu/kernels/turned_kernels.h"

namespace bp {

namespace {

// ---------------------------------------------------------------- tables

/// A place in one table, from its number: y fastest, then w, then z.
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

/// Returns the OR of four words each of two tables, y to y + 3; y is a multiple of 4.
__device__ uint4 either(const uint4& a, const uint4& b) {
  return make_uint4(a.x | b.x, a.y | b.y, a.z | b.z, a.w | b.w);
}
__device__ uint4 four_at(const std::uint32_t* table, std::uint32_t i, bool inside) {
  return inside ? *reinterpret_cast<const uint4*>(table + i) : make_uint4(0, 0, 0, 0);
}

/// Makes windows of twice the length along x, from windows of length `shift`.
__global__ void __launch_bounds__(kPassThreads)
    double_along_kernel(const std::uint32_t* __restrict__ from, GridShape shape, int shift,
                        std::uint32_t* __restrict__ to) {
  const std::uint32_t i = 4 * thread_in_grid(), column = std::uint32_t(shape.ny);
  if (i >= shape.word_count()) return;
  const int w = column_at(shape, i).w + shift / 32;
  const unsigned bits = unsigned(shift) & 31;
  const std::uint32_t at = i + std::uint32_t(shift / 32) * column;
  const uint4 near = four_at(from, at, w < shape.words), far = four_at(from, at + column, w + 1 < shape.words);
  *reinterpret_cast<uint4*>(to + i) = either(
      four_at(from, i, true), make_uint4(__funnelshift_r(near.x, far.x, bits), __funnelshift_r(near.y, far.y, bits),
                                         __funnelshift_r(near.z, far.z, bits), __funnelshift_r(near.w, far.w, bits)));
}

/// Makes windows of 4 kRows rows each way across, from those of kRows, 1 or 4.
template <int kRows>
__global__ void __launch_bounds__(kPassThreads)
    widen_across_kernel(const std::uint32_t* __restrict__ from, GridShape shape, std::uint32_t* __restrict__ to) {
  const std::uint32_t i = 4 * thread_in_grid(), plane = std::uint32_t(shape.words) * std::uint32_t(shape.ny);
  if (i >= shape.word_count()) return;
  const Column c = column_at(shape, i);
  uint4 own = make_uint4(0, 0, 0, 0), next = own;
#pragma unroll
  for (int k = 0; k < 4; ++k) {
    const bool inside = c.z + k * kRows < shape.nz;
    const std::uint32_t at = i + std::uint32_t(k * kRows) * plane;
    own = either(own, four_at(from, at, inside));
#pragma unroll
    for (int j = 1; j < (kRows == 1 ? 2 : 4); ++j)
      next = either(next, four_at(from, at + std::uint32_t(4 * j), inside && c.y + 4 * j < shape.ny));
  }
  if constexpr (kRows == 1) {
    const std::uint32_t yzw = own.y | own.z | own.w, xyz = next.x | next.y | next.z;
    own = make_uint4(own.x | yzw, yzw | next.x, own.z | own.w | next.x | next.y, own.w | xyz);
  } else {
    own = either(own, next);
  }
  *reinterpret_cast<uint4*>(to + i) = own;
}

// ---------------------------------------------------------------- what is asked

/// Returns the work item of one warp: the quad of cells, and a mask of its cells whose cubes are alike.
__device__ std::uint32_t item_of(std::uint32_t quad, unsigned cells) {
  return quad << 4 | cells;
}
/// Returns the 8 voxels of a word in each of the given cells.
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

/// Lists the quads with open voxels, once for each set of cells that are alike.
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

/// The voxels lo to hi of a row; none if hi < lo.
struct Stretch {
  int lo, hi;
  __device__ bool empty() const { return hi < lo; }
};

struct TurnedCube {
  Rotation rotation;  ///< canonical: no row begins with a negative number
  int least, most;    ///< S: voxels between `least` and `most` decide for themselves
  int reach;

  __device__ static int limit(int s) { return s * ((1 << kRotationBits) / kScaleOne); }

  /// Returns the x that lie in the cube of a scale in any of `rows` x `rows` rows from (y, z) on. For several rows it
  /// may return some more.
  __device__ Stretch stretch(int scale, int y, int z, int rows) const {
    Stretch s{-reach, reach};
#pragma unroll
    for (int i = 0; i < 3; ++i) {  // solves |a x + t| <= limit
      const int a = rotation.row[i][0], b = rotation.row[i][1], c = rotation.row[i][2];
      const int t = b * y + c * z, low = t + (min(b, 0) + min(c, 0)) * (rows - 1),
                high = t + (max(b, 0) + max(c, 0)) * (rows - 1);
      const int first = -limit(scale) - high, last = limit(scale) - low;
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

  /// Finds the voxels from which a voxel of the rows from (dy, dz) on meets G.
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

  /// Returns those of the given voxels of a lane's word whose own cube meets G in row (dy, dz).
  __device__ std::uint32_t decide(std::uint32_t voxels, int half, int dy, int dz) const {
    std::uint32_t met = 0;
    for (; voxels != 0; voxels &= voxels - 1) {
      const int x = __ffs(int(voxels)) - 1;
      const Stretch s = cube.stretch(a.scale.at(32 * at.w + x, at.y, at.z + 4 * half), dy, dz, 1);
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

  /// Calls f(stretch, dy, dz) for the stretches of the lanes with `wanted`.
  template <class F>
  __device__ void for_each(bool wanted, Stretch own, int dy, int dz, const F& f) const {
    for (unsigned left = __ballot_sync(kAllLanes, wanted); left != 0; left &= left - 1) {
      const int i = __ffs(int(left)) - 1;
      f(Stretch{__shfl_sync(kAllLanes, own.lo, i), __shfl_sync(kAllLanes, own.hi, i)}, __shfl_sync(kAllLanes, dy, i),
        __shfl_sync(kAllLanes, dz, i));
    }
  }

  /// Asks row by row: the cube of the least scale decides. Where the largest cube reaches further, each voxel decides
  /// for itself.
  __device__ void ask_row(bool inside, int dy, int dz) {
    std::uint32_t met[2];
    const Stretch sure = cube.stretch(cube.least, dy, dz, 1);
    for_each(inside && !sure.empty(), sure, dy, dz, [&](Stretch s, int y, int z) {
      meet(0, s, y, z, met);
      open[0] &= ~met[0], open[1] &= ~met[1];
    });
    if (cube.least == cube.most) return;
    const Stretch some = cube.stretch(cube.most, dy, dz, 1);
    for_each(inside && !some.empty(), some, dy, dz, [&](Stretch s, int y, int z) {
      meet(0, s, y, z, met);
      open[0] &= ~decide(met[0] & open[0], 0, y, z), open[1] &= ~decide(met[1] & open[1], 1, y, z);
    });
  }

  /// Asks for across^2 blocks of rows of a level; the first begins at (y0, z0).
  template <int kLevel>
  __device__ void ask(int y0, int z0, int across) {
    constexpr int kRows = rows_across(kLevel);
    for (int first = 0; first < across * across && any_open(); first += kWarp) {
      const int dy = y0 + (first + lane_id()) % across * kRows, dz = z0 + (first + lane_id()) / across * kRows;
      const bool inside = first + lane_id() < across * across && dy <= cube.reach && dz <= cube.reach;
      if constexpr (kLevel == 0) {
        ask_row(inside, dy, dz);
      } else {
        const Stretch some = cube.stretch(cube.most, dy, dz, kRows);
        for_each(inside && !some.empty(), some, dy, dz, [&](Stretch s, int y, int z) {
          std::uint32_t met[2];
          meet(kLevel, s, y, z, met);
          if (__any_sync(kAllLanes, ((met[0] & open[0]) | (met[1] & open[1])) != 0)) ask<kLevel - 1>(y, z, 4);
        });
      }
    }
  }
};

/// Number of blocks of the next kernel on a multiprocessor.
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
  const unsigned blocks = blocks_for(words), fours = blocks_for(words / 4);
  TurnedTables tables;
  tables.last = last_octave(longest);
  for (int level = 0; level < kTurnedLevels; ++level) {
    for (int k = first_octave(level); k <= tables.last; ++k, memory += words) {
      tables.table[level][k] = memory;
      if (level > 0) {
        launch("widen_across_kernel", level == 1 ? widen_across_kernel<1> : widen_across_kernel<4>, fours, kPassThreads,
               0, stream, tables.table[level - 1][k], shape, memory);
      } else if (k > 0) {
        launch("double_along_kernel", double_along_kernel, fours, kPassThreads, 0, stream, tables.table[0][k - 1],
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
