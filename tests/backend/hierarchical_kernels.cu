// [CB17] Alg. 1 (dilation) and Alg. 2 (erosion), section 3.3; the half-resolution first pass of "Additional Speed-Up",
// made exact: a block is settled only if a cell in the walk proves it for all of its voxels.
#include <algorithm>

#include "gpu/kernels/launch.h"
#include "tests/backend/hierarchical_kernels.h"

namespace bp {

namespace {

constexpr int kMaxTop = 8;      ///< levels in the register stack, a byte each
constexpr int kScaleLevel = 3;  ///< finest level with a scale of its own: a lattice cell

/// Level k holds a byte per cell of 2^k voxels a side: which of its eight children (of level k-1) are occupied.
struct PyramidView {
  const std::uint8_t* nodes;
  const Scale* scales;  ///< per node of level >= kScaleLevel: largest S in it; null where S is constant
  std::int32_t nx, ny, nz;
  std::uint32_t offset[kMaxTop + 1], scale_offset[kMaxTop + 1];
  std::int32_t top;

  /// Cells of a level along each axis, and in all.
  __host__ __device__ int3 size(int level) const {
    const int up = (1 << level) - 1;
    return make_int3((nx + up) >> level, (ny + up) >> level, (nz + up) >> level);
  }
  __host__ __device__ std::uint32_t count(int level) const {
    const int3 n = size(level);
    return std::uint32_t(n.x) * std::uint32_t(n.y) * std::uint32_t(n.z);
  }
  __device__ std::uint32_t index(int level, int x, int y, int z) const {
    const int3 n = size(level);
    return (std::uint32_t(z) * std::uint32_t(n.y) + std::uint32_t(y)) * std::uint32_t(n.x) + std::uint32_t(x);
  }
  /// The cell with this index.
  __device__ int3 cell(int level, std::uint32_t i) const {
    const int3 n = size(level);
    const std::uint32_t rest = i / std::uint32_t(n.x);
    return make_int3(int(i - rest * std::uint32_t(n.x)), int(rest % std::uint32_t(n.y)),
                     int(rest / std::uint32_t(n.y)));
  }
  __device__ std::uint32_t node(int level, int x, int y, int z) const {
    return nodes[offset[level] + index(level, x, y, z)];
  }
  __device__ Scale largest_scale(int level, int x, int y, int z) const {
    const int up = level < kScaleLevel ? kScaleLevel - level : 0;
    return scales[scale_offset[level + up] + index(level + up, x >> up, y >> up, z >> up)];
  }
};

// ---------------------------------------------------------------- building

__global__ void __launch_bounds__(kPassThreads)
    first_level_kernel(const std::uint32_t* __restrict__ bits, GridShape shape, std::uint8_t* __restrict__ out) {
  const unsigned i = thread_in_grid(), ny = unsigned(shape.ny / 2);
  if (i >= shape.word_count() / 4) return;
  const unsigned rest = i / unsigned(shape.words);
  const int w = int(i - rest * unsigned(shape.words)), y = int(rest % ny), z = int(rest / ny);
  const std::uint32_t a = bits[shape.word(w, 2 * y, 2 * z)], b = bits[shape.word(w, 2 * y + 1, 2 * z)],
                      c = bits[shape.word(w, 2 * y, 2 * z + 1)], d = bits[shape.word(w, 2 * y + 1, 2 * z + 1)];
  std::uint32_t* to = reinterpret_cast<std::uint32_t*>(
      out + (std::size_t(z) * ny + unsigned(y)) * std::size_t(16 * shape.words) + 16 * std::size_t(w));
#pragma unroll
  for (int q = 0; q < 4; ++q) {
    std::uint32_t four = 0;
#pragma unroll
    for (int k = 0; k < 4; ++k) {
      const int s = 2 * (4 * q + k);
      four |= ((a >> s & 3) | (b >> s & 3) << 2 | (c >> s & 3) << 4 | (d >> s & 3) << 6) << (8 * k);
    }
    to[q] = four;
  }
}

__global__ void __launch_bounds__(kPassThreads)
    next_level_kernel(const __grid_constant__ PyramidView t, int level, std::uint8_t* __restrict__ nodes) {
  const unsigned i = thread_in_grid();
  if (i >= t.count(level)) return;
  const int3 own = t.cell(level, i), end = t.size(level - 1);
  std::uint32_t mask = 0;
#pragma unroll
  for (int c = 0; c < 8; ++c) {
    const int x = 2 * own.x + (c & 1), y = 2 * own.y + (c >> 1 & 1), z = 2 * own.z + (c >> 2);
    if (x < end.x && y < end.y && z < end.z && t.node(level - 1, x, y, z) != 0) mask |= 1u << c;
  }
  nodes[t.offset[level] + i] = std::uint8_t(mask);
}

/// Largest S of each cell of level kScaleLevel, and of each coarser one from eight below.
__global__ void __launch_bounds__(kPassThreads)
    scale_level_kernel(const __grid_constant__ PyramidView t, ScaleView scale, int level, Scale* __restrict__ out) {
  const unsigned i = thread_in_grid();
  if (i >= t.count(level)) return;
  const int3 own = t.cell(level, i);
  std::uint32_t most = 0;
  if (level == kScaleLevel) {
#pragma unroll
    for (int c = 0; c < 8; ++c) most = max(most, scale.sample(own.x + (c & 1), own.y + (c >> 1 & 1), own.z + (c >> 2)));
  } else {
    const int3 end = t.size(level - 1);
    for (int c = 0; c < 8; ++c) {
      const int x = min(2 * own.x + (c & 1), end.x - 1), y = min(2 * own.y + (c >> 1 & 1), end.y - 1),
                z = min(2 * own.z + (c >> 2), end.z - 1);
      most = max(most, std::uint32_t(out[t.scale_offset[level - 1] + t.index(level - 1, x, y, z)]));
    }
  }
  out[t.scale_offset[level] + i] = Scale(most);
}

// ---------------------------------------------------------------- elements

enum class Meets { no, partly, wholly };

/// Least and largest distance along one axis between voxels [p, p + n) and [c, c + m).
__device__ int least_gap(int p, int n, int c, int m) {
  return max(max(c - (p + n - 1), p - (c + m - 1)), 0);
}
__device__ int largest_gap(int p, int n, int c, int m) {
  return max(c + m - 1 - p, p + n - 1 - c);
}

/// The block of `edge`^3 voxels whose dilation is asked for, with a cube or ball around it: one size for all of its
/// voxels, or bounds of the sizes.
struct CubeElement {
  int x, y, z, edge, least, most;  ///< radius: every voxel of the block has at least `least`, none more than `most`
  __device__ int reach() const { return most; }
  __device__ Meets meets(const PyramidView&, int level, int cx, int cy, int cz) const {
    const int m = 1 << level;
    const int gap =
        max(max(least_gap(x, edge, cx * m, m), least_gap(y, edge, cy * m, m)), least_gap(z, edge, cz * m, m));
    if (gap > most) return Meets::no;
    const int far =
        max(max(largest_gap(x, edge, cx * m, m), largest_gap(y, edge, cy * m, m)), largest_gap(z, edge, cz * m, m));
    return far <= least ? Meets::wholly : Meets::partly;
  }
};
struct BallElement {
  int x, y, z, edge, least, most, radius;  ///< least, most: of w
  __device__ int reach() const { return radius; }
  __device__ Meets meets(const PyramidView&, int level, int cx, int cy, int cz) const {
    const int m = 1 << level;
    const int a = least_gap(x, edge, cx * m, m), b = least_gap(y, edge, cy * m, m), c = least_gap(z, edge, cz * m, m);
    if (a * a + b * b + c * c >= most) return Meets::no;
    const int d = largest_gap(x, edge, cx * m, m), e = largest_gap(y, edge, cy * m, m),
              f = largest_gap(z, edge, cz * m, m);
    return d * d + e * e + f * f < least ? Meets::wholly : Meets::partly;
  }
};
/// A cube of its own orientation: separated from a node along one of the cube's axes, or not. Doubled coordinates, so
/// that centres are whole numbers.
struct OrientedElement {
  int x, y, z, edge, least, most, radius;  ///< least, most: of S
  Rotation rotation;
  __device__ int reach() const { return radius; }
  __device__ Meets meets(const PyramidView&, int level, int cx, int cy, int cz) const {
    const int m = 1 << level, half = edge + m - 2;
    const int dx = 2 * (x - cx * m) + edge - m, dy = 2 * (y - cy * m) + edge - m, dz = 2 * (z - cz * m) + edge - m;
    bool wholly = true;
#pragma unroll
    for (int i = 0; i < 3; ++i) {
      const int a = rotation.row[i][0], b = rotation.row[i][1], c = rotation.row[i][2];
      const int along = abs(a * dx + b * dy + c * dz), spread = (abs(a) + abs(b) + abs(c)) * half;
      if (along - spread > most * kDoubledUnit) return Meets::no;
      wholly = wholly && along + spread <= least * kDoubledUnit;
    }
    return wholly ? Meets::wholly : Meets::partly;
  }
  static constexpr int kDoubledUnit = 2 * (1 << kRotationBits) / kScaleOne;
};
/// Alg. 2: the ball belongs to the seed; a node is as large as its largest scale.
struct SeedBallElement {
  int x, y, z, edge, radius;
  ScaleView scale;
  __device__ int reach() const { return radius; }
  __device__ Meets meets(const PyramidView& t, int level, int cx, int cy, int cz) const {
    const int m = 1 << level;
    const int a = least_gap(x, edge, cx * m, m), b = least_gap(y, edge, cy * m, m), c = least_gap(z, edge, cz * m, m);
    if (a * a + b * b + c * c >= ball_bound(t.largest_scale(level, cx, cy, cz))) return Meets::no;
    if (level > 0) return Meets::partly;
    const int w = ball_bound(scale.at(cx, cy, cz));
    const int d = largest_gap(x, edge, cx, 1), e = largest_gap(y, edge, cy, 1), f = largest_gap(z, edge, cz, 1);
    if (d * d + e * e + f * f < w) return Meets::wholly;
    return a * a + b * b + c * c < w ? Meets::partly : Meets::no;
  }
};

// ---------------------------------------------------------------- the walk

__device__ std::uint32_t swap_children(std::uint32_t mask, int with) {
  if (with & 1) mask = (mask & 0xaa) >> 1 | (mask & 0x55) << 1;
  if (with & 2) mask = (mask & 0xcc) >> 2 | (mask & 0x33) << 2;
  if (with & 4) mask = mask >> 4 | (mask & 0x0f) << 4;
  return mask;
}

/// The answer of the occupied voxels for the element's block: wholly - some voxel is in reach of all of the block's
/// voxels; no - none is in reach of any; partly - neither is known. For a block of one voxel the answer is exact: never
/// partly.
template <class Element>
__device__ Meets walk(const PyramidView& t, const Element& e) {
  const int top = t.top, reach = e.reach();
  bool partly = false;
  const int x0 = max(e.x - reach, 0) >> top, x1 = min(e.x + e.edge - 1 + reach, t.nx - 1) >> top;
  const int y0 = max(e.y - reach, 0) >> top, y1 = min(e.y + e.edge - 1 + reach, t.ny - 1) >> top;
  const int z0 = max(e.z - reach, 0) >> top, z1 = min(e.z + e.edge - 1 + reach, t.nz - 1) >> top;
  for (int sz = z0; sz <= z1; ++sz) {
    for (int sy = y0; sy <= y1; ++sy) {
      for (int sx = x0; sx <= x1; ++sx) {
        int level = top, x = sx, y = sy, z = sz;
        std::uint64_t stack = std::uint64_t(t.node(level, x, y, z))
                              << (8 * (level - 1));  // byte k-1: children of level k to go
        while (level <= top) {
          const std::uint32_t left = std::uint32_t(stack >> (8 * (level - 1))) & 255;
          if (left == 0) {
            ++level, x >>= 1, y >>= 1, z >>= 1;
            continue;
          }
          const int half = 1 << (level - 1);
          const int nearest = int(e.x >= 2 * x * half + half) | int(e.y >= 2 * y * half + half) << 1 |
                              int(e.z >= 2 * z * half + half) << 2;
          const int c = (__ffs(int(swap_children(left, nearest))) - 1) ^ nearest;
          stack &= ~(std::uint64_t(1) << (8 * (level - 1) + c));
          const int cx = 2 * x + (c & 1), cy = 2 * y + (c >> 1 & 1), cz = 2 * z + (c >> 2);
          const Meets m = e.meets(t, level - 1, cx, cy, cz);
          if (m == Meets::no) continue;
          if (m == Meets::wholly) return Meets::wholly;
          if (level == 1) {
            partly = true;
            continue;
          }
          --level, x = cx, y = cy, z = cz;
          stack |= std::uint64_t(t.node(level, x, y, z)) << (8 * (level - 1));
        }
      }
    }
  }
  return partly ? Meets::partly : Meets::no;
}

enum class Shape { ball, cube, oriented };

/// The query at a block of voxels, and its field.
struct Question {
  bool erosion;
  Shape shape;      ///< of the dilation
  int radius;       ///< largest
  int bound;        ///< largest w
  ScaleView scale;  ///< samples null: constant
  RotationView rotations;
};

/// Returns bounds of S over a block of 2^3 voxels, or at one voxel.
__device__ void scale_over(const ScaleView& s, int x, int y, int z, int edge, int& least, int& most) {
  least = 0xffff, most = 0;
  for (int c = 0; c < edge * edge * edge; ++c) {
    const int v = s.at(x + (c & 1), y + (c >> 1 & 1), z + (c >> 2));
    least = min(least, v), most = max(most, v);
  }
}

template <bool kErosion, Shape kShape, bool kVarying>
__device__ Meets ask(const PyramidView& t, const Question& q, int x, int y, int z, int edge) {
  if (kErosion && kVarying) return walk(t, SeedBallElement{x, y, z, edge, q.radius, q.scale});
  int least = q.scale.constant, most = least;
  if (kVarying) scale_over(q.scale, x, y, z, edge, least, most);
  if (kShape == Shape::cube)
    return walk(t, CubeElement{x, y, z, edge, cube_radius(Scale(least)), cube_radius(Scale(most))});
  if (kShape == Shape::oriented)
    return walk(t, OrientedElement{x, y, z, edge, least, most, q.radius, q.rotations.at(x, y, z)});
  int radius = q.radius;
  if (kVarying) radius = most / kScaleOne + 1;
  return walk(t, BallElement{x, y, z, edge, ball_bound(Scale(least)), ball_bound(Scale(most)), radius});
}

/// A warp's voxels: 8 x 2 x 2, so that its walks stay together and each row of eight is a byte of the result.
struct WarpBlock {
  int x, y, z;  ///< of this lane
  bool inside;
  __device__ WarpBlock(int nx, int ny, int nz) {
    const unsigned warp = thread_in_grid() / kWarp, bx = unsigned(nx) / 8, by = unsigned(ny) / 2;
    const int lane = lane_id();
    x = int(warp % bx) * 8 + (lane & 7);
    y = int(warp / bx % by) * 2 + (lane >> 3 & 1);
    z = int(warp / (bx * by)) * 2 + (lane >> 4);
    inside = z < nz;
  }
};

/// Alg. 1 and 2 at every voxel. out := D, or E.
template <bool kErosion, Shape kShape, bool kVarying>
__global__ void __launch_bounds__(kPassThreads)
    every_voxel_kernel(const __grid_constant__ PyramidView t, const __grid_constant__ Question q, GridShape shape,
                       VoxelRange region, const std::uint32_t* __restrict__ solid,
                       const std::uint32_t* __restrict__ dilated, std::uint8_t* __restrict__ out) {
  const WarpBlock b(32 * shape.words, shape.ny, shape.nz);
  bool bit = false;
  if (b.inside) {
    const std::uint32_t at = shape.word(b.x >> 5, b.y, b.z), one = 1u << (b.x & 31);
    const bool g = solid[at] & one, asked = region.mask(b.x >> 5, b.y, b.z) & one;
    bit = g && asked;
    if (asked && !g && (!kErosion || (dilated[at] & one))) {
      const bool met = ask<kErosion, kShape, kVarying>(t, q, b.x, b.y, b.z, 1) == Meets::wholly;
      bit = kErosion ? !met : met;
    }
  }
  const std::uint32_t bits = __ballot_sync(kAllLanes, bit);
  if (b.inside && (b.x & 7) == 0)
    out[std::size_t(shape.word(0, b.y, b.z)) * 4 + unsigned(b.x) / 8] = std::uint8_t(bits >> (lane_id() & 24));
}

/// The half-resolution pass: one lane per block of 2^3 voxels. Settled blocks are written, the others listed.
template <bool kErosion, Shape kShape, bool kVarying>
__global__ void __launch_bounds__(kPassThreads)
    every_block_kernel(const __grid_constant__ PyramidView t, const __grid_constant__ Question q, GridShape shape,
                       VoxelRange region, const std::uint32_t* __restrict__ solid,
                       const std::uint32_t* __restrict__ dilated, std::uint16_t* __restrict__ out,
                       std::uint32_t* __restrict__ list, std::uint32_t* __restrict__ count) {
  const WarpBlock b(16 * shape.words, shape.ny / 2, shape.nz / 2);
  bool all = false, open = false;
  if (b.inside) {
    bool asked = false;
    const int s = 2 * (b.x & 15);
#pragma unroll
    for (int r = 0; r < 4; ++r) {
      const int y = 2 * b.y + (r & 1), z = 2 * b.z + (r >> 1);
      const std::uint32_t at = shape.word(b.x >> 4, y, z);
      std::uint32_t v = region.mask(b.x >> 4, y, z) & ~solid[at];
      if (kErosion) v &= dilated[at];
      asked = asked || (v >> s & 3) != 0;
    }
    if (asked) {
      const Meets m = ask<kErosion, kShape, kVarying>(t, q, 2 * b.x, 2 * b.y, 2 * b.z, 2);
      open = m == Meets::partly;
      all = kErosion ? m == Meets::no : m == Meets::wholly;
    }
  }
  append(open,
         b.inside
             ? (unsigned(b.z) * unsigned(shape.ny / 2) + unsigned(b.y)) * unsigned(16 * shape.words) + unsigned(b.x)
             : 0,
         list, count);
  const std::uint32_t settled = __ballot_sync(kAllLanes, all);
  const int lane = lane_id(), first_x = b.x - (lane & 7), first_y = b.y - (lane >> 3 & 1), first_z = b.z - (lane >> 4);
  if (lane < 16 && first_z < shape.nz / 2) {  // 16 rows of 16 voxels
    const int y = 2 * first_y + (lane & 3), z = 2 * first_z + (lane >> 2);
    std::uint32_t eight = settled >> (8 * ((lane >> 1 & 1) + 2 * (lane >> 3))) & 255;
    eight = (eight | eight << 4) & 0x0f0f;
    eight = (eight | eight << 2) & 0x3333;
    eight = (eight | eight << 1) & 0x5555;
    const std::uint32_t at = shape.word(first_x >> 4, y, z), shift = 2u * (unsigned(first_x) & 8u);
    std::uint32_t v = eight | eight << 1;
    if (kErosion) v &= dilated[at] >> shift;
    v |= solid[at] >> shift;
    v &= region.mask(first_x >> 4, y, z) >> shift;
    out[std::size_t(at) * 2 + (shift >> 4)] = std::uint16_t(v);
  }
}

/// Decides the open blocks, voxel by voxel: four blocks to a warp.
template <bool kErosion, Shape kShape, bool kVarying>
__global__ void __launch_bounds__(kPassThreads)
    open_blocks_kernel(const __grid_constant__ PyramidView t, const __grid_constant__ Question q, GridShape shape,
                       VoxelRange region, const std::uint32_t* __restrict__ solid,
                       const std::uint32_t* __restrict__ dilated, const std::uint32_t* __restrict__ list,
                       const std::uint32_t* __restrict__ count, std::uint32_t* __restrict__ out) {
  const std::uint64_t n = std::uint64_t(*count) * 8;
  for (std::uint64_t i = thread_in_grid(); i < n; i += std::uint64_t(gridDim.x) * blockDim.x) {
    const std::uint32_t block = list[i / 8], row = unsigned(16 * shape.words), c = std::uint32_t(i & 7);
    const int x = 2 * int(block % row) + int(c & 1),
              y = 2 * int(block / row % unsigned(shape.ny / 2)) + int(c >> 1 & 1),
              z = 2 * int(block / row / unsigned(shape.ny / 2)) + int(c >> 2);
    const std::uint32_t at = shape.word(x >> 5, y, z), one = 1u << (x & 31);
    if (!(region.mask(x >> 5, y, z) & one) || (solid[at] & one) || (kErosion && !(dilated[at] & one))) continue;
    const bool met = ask<kErosion, kShape, kVarying>(t, q, x, y, z, 1) == Meets::wholly;
    if (met != kErosion) atomicOr(&out[at], one);
  }
}

/// Calls f(erosion, shape, varying) with the three as compile-time constants.
template <bool kErosion, Shape kShape, class F>
void with_varying(bool varying, F f) {
  if (varying) {
    f.template operator()<kErosion, kShape, true>();
  } else {
    f.template operator()<kErosion, kShape, false>();
  }
}
template <class F>
void with_question(const Question& q, F f) {
  const bool varying = q.scale.samples != nullptr;
  if (q.erosion) return with_varying<true, Shape::ball>(varying, f);
  if (q.shape == Shape::cube) return with_varying<false, Shape::cube>(varying, f);
  if (q.shape == Shape::oriented) return with_varying<false, Shape::oriented>(varying, f);
  with_varying<false, Shape::ball>(varying, f);
}

}  // namespace

void HierarchicalClosing::enqueue(const TileLayout& layout, const std::uint32_t* solid, const ScaleLattice& scale,
                                  const Scale* samples, StructuringElement element, HierarchicalVariant variant,
                                  std::uint32_t* closed, cudaStream_t stream, const DeviceClosing::Mark& mark,
                                  const RotationView* rotations) {
  const GridShape& shape = layout.shape;
  const std::size_t words = shape.word_count();
  solid_.grow(words), dilated_.grow(words), contour_.grow(words), closed_.grow(words);
  cells_.grow(2 * shape.quad_count());
  BP_CUDA_CHECK(cudaMemsetAsync(cells_.data(), 0, 2 * shape.quad_count() * 4, stream));
  pack_bits(solid, layout.solid, shape, solid_.data(), cells_.data(), stream);

  PyramidView t{};
  t.nx = 32 * shape.words, t.ny = shape.ny, t.nz = shape.nz;
  const int reach = rotations != nullptr ? oriented_reach(scale.max) : scale.max / kScaleOne + 1;
  t.top = kScaleLevel;
  while (t.top < kMaxTop && (1 << t.top) < 2 * reach + 1) ++t.top;
  std::uint32_t nodes = 0, scales = 0;
  for (int k = 1; k <= t.top; ++k) {
    t.offset[k] = nodes, t.scale_offset[k] = scales;
    nodes += (t.count(k) + 3) / 4 * 4;
    if (k >= kScaleLevel) scales += t.count(k);
  }
  t.nodes = nodes_.grow(nodes);
  const auto build = [&](const std::uint32_t* bits) {
    launch("first_level_kernel", first_level_kernel, blocks_for(words / 4), kPassThreads, 0, stream, bits, shape,
           nodes_.data());
    for (int k = 2; k <= t.top; ++k)
      launch("next_level_kernel", next_level_kernel, blocks_for(t.count(k)), kPassThreads, 0, stream, t, k,
             nodes_.data());
  };
  const Shape shape_of_element = rotations != nullptr                  ? Shape::oriented
                                 : element == StructuringElement::cube ? Shape::cube
                                                                       : Shape::ball;
  Question q{false, shape_of_element, reach, ball_bound(scale.max), {}, {}};
  if (rotations != nullptr) q.rotations = *rotations;
  q.scale.constant = scale.max;
  if (!scale.constant()) {
    q.scale.samples = samples;
    q.scale.nx = scale.size.x, q.scale.ny = scale.size.y, q.scale.nz = scale.size.z;
    q.scale.ox = layout.ox, q.scale.oy = layout.oy, q.scale.oz = layout.oz;
    t.scales = scales_.grow(scales);
    for (int k = kScaleLevel; k <= t.top; ++k)
      launch("scale_level_kernel", scale_level_kernel, blocks_for(t.count(k)), kPassThreads, 0, stream, t, q.scale, k,
             scales_.data());
  }
  const auto collide = [&](const VoxelRange& region, std::uint32_t* out) {
    with_question(q, [&]<bool kErosion, Shape kShape, bool kVarying>() {
      if (variant == HierarchicalVariant::plain) {
        launch("every_voxel_kernel", every_voxel_kernel<kErosion, kShape, kVarying>, blocks_for(words * 32),
               kPassThreads, 0, stream, t, q, shape, region, solid_.data(), dilated_.data(),
               reinterpret_cast<std::uint8_t*>(out));
        return;
      }
      blocks_.grow(words * 4);
      BP_CUDA_CHECK(cudaMemsetAsync(count_.grow(1), 0, 4, stream));
      launch("every_block_kernel", every_block_kernel<kErosion, kShape, kVarying>, blocks_for(words * 4), kPassThreads,
             0, stream, t, q, shape, region, solid_.data(), dilated_.data(), reinterpret_cast<std::uint16_t*>(out),
             blocks_.data(), count_.data());
      launch("open_blocks_kernel", open_blocks_kernel<kErosion, kShape, kVarying>, unsigned(multiprocessors_) * 8,
             kPassThreads, 0, stream, t, q, shape, region, solid_.data(), dilated_.data(), blocks_.data(),
             count_.data(), out);
    });
  };
  const auto done = [&](const char* stage) {
    if (mark) mark(stage);
  };
  build(solid_.data());
  done("pack and pyramid");
  collide(layout.dilated, dilated_.data());
  done("dilate");
  outer_contour(dilated_.data(), shape, contour_.data(), cells_.data() + shape.quad_count(), stream);
  build(contour_.data());
  done("contour and pyramid");
  q.erosion = true;
  collide(layout.interior, closed_.data());
  done("erode");
  unpack_bits(closed_.data(), shape, layout.closed, layout.interior, closed, stream);
  done("unpack");
}

}  // namespace bp
