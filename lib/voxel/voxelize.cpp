#include "lib/voxel/voxelize.h"

#include <algorithm>

#include "lib/voxel/overlap.h"
#include "lib/voxel/voxelize_brick.h"

// [SS10] Schwarz and Seidel, Fast parallel surface and solid voxelization on GPUs, 2010. We differ in that all
// decisions are made in integers, and in that a large triangle is walked by rows: each half-space is linear, so that
// along a row it leaves an interval.

namespace bp {

namespace {

CellRange intersect(const CellRange& a, const VoxelBox& b) {
  CellRange r = a;
  for (int axis = 0; axis < 3; ++axis) {
    r.min[axis] = std::max<std::int64_t>(r.min[axis], b.min[axis]);
    r.max[axis] = std::min<std::int64_t>(r.max[axis], b.max[axis]);
  }
  return r;
}

/// Rows of a box of voxels that belong to one thread.
class BoxRows {
 public:
  explicit BoxRows(BitBox& bits) : bits_(bits) {}
  [[nodiscard]] const VoxelBox& box() const { return bits_.box(); }
  /// Sets the voxels [begin, end] along x.
  void set(std::int64_t begin, std::int64_t end, std::int64_t y, std::int64_t z) {
    std::uint64_t* word = word_at(begin, y, z);
    std::uint64_t* const last = word_at(end, y, z);
    if (word == last) {
      *word |= bits_between(begin, end);
      return;
    }
    *word++ |= bits_between(begin, 63);
    while (word != last) *word++ = ~std::uint64_t(0);
    *word |= bits_between(0, end);
  }
  /// Sets the voxels of a word's low bits, beginning with voxel x.
  void set_few(std::uint64_t few, std::int64_t x, std::int64_t y, std::int64_t z) {
    std::uint64_t* const word = word_at(x, y, z);
    word[0] |= few << (x & 63);
    const std::uint64_t rest = (few >> 1) >> (63 - (x & 63));
    if (rest != 0) word[1] |= rest;
  }
  [[nodiscard]] bool has(std::int64_t begin, std::int64_t end, std::int64_t y, std::int64_t z) const {
    const std::uint64_t* const word = word_at(begin, y, z);
    const std::uint64_t bits = bits_between(begin, end);
    return word == word_at(end, y, z) && (*word & bits) == bits;
  }

 private:
  [[nodiscard]] std::uint64_t* word_at(std::int64_t x, std::int64_t y, std::int64_t z) const {
    return bits_.row(std::int32_t(y), std::int32_t(z)) + ((x - bits_.box().min.x) >> 6);
  }
  BitBox& bits_;
};

/// Calls emit(x0, x1, y, z), both ends included, for each row of cells that the triangle meets.
template <class EdgeInt, class PlaneInt, class Emit>
void for_each_row(const TriangleCells<EdgeInt, PlaneInt>& t, const Emit& emit) {
  const std::int32_t nx = std::int32_t(t.range.size(0)), ny = std::int32_t(t.range.size(1)),
                     nz = std::int32_t(t.range.size(2));
  // In a slice a half-space holds only in rows where it holds at the better end of the row: that bounds y.
  const auto clip_slice = [&](const auto& h, std::int32_t z, std::int32_t& y0, std::int32_t& y1) {
    const std::int32_t best = h.step[0] > 0 ? nx - 1 : 0;
    return clip(h.value(best, 0, z), h.step[1], y0, y1);
  };
  for (std::int32_t z = 0; z < nz; ++z) {
    std::int32_t y0 = 0, y1 = ny - 1;
    bool any = true;
    for (int i = 0; i < 9 && any; ++i) any = clip_slice(t.edges[i], z, y0, y1);
    for (int i = 0; i < 2 && any; ++i) any = clip_slice(t.plane[i], z, y0, y1);
    for (std::int32_t y = y0; any && y <= y1; ++y) {
      std::int32_t x0 = 0, x1 = nx - 1;
      bool row = true;
      for (int i = 0; i < 2 && row; ++i) row = clip(t.plane[i].value(0, y, z), t.plane[i].step[0], x0, x1);
      for (int i = 3; i < 9 && row; ++i) row = clip(t.edges[i].value(0, y, z), t.edges[i].step[0], x0, x1);
      if (row && x0 <= x1) emit(x0, x1, y, z);
    }
  }
}

template <class Triangle, class Rows>
void voxelize_rows(const Corners& corners, const CellRange& range, Rows& out) {
  const Triangle t(corners, range, kFixedOne);
  for_each_row(t, [&](std::int32_t x0, std::int32_t x1, std::int32_t y, std::int32_t z) {
    out.set(range.min[0] + x0, range.min[0] + x1, range.min[1] + y, range.min[2] + z);
  });
}

/// Bit x is set where all the half-spaces hold, given their values at the row's first voxel.
template <int kCount>
std::uint64_t row_bits(std::int64_t (&value)[kCount], const std::int64_t (&step)[kCount], std::int32_t nx) {
  std::uint64_t bits = 0;
  for (std::int32_t x = 0; x < nx; ++x) {
    std::int64_t sign = value[0];
    for (int i = 1; i < kCount; ++i) sign |= value[i];
    bits |= std::uint64_t(sign >= 0) << x;
    for (int i = 0; i < kCount; ++i) value[i] += step[i];
  }
  return bits;
}

/// Tests each voxel of a small range.
template <class Rows>
void voxelize_few(const Corners& corners, const CellRange& range, Rows& out) {
  const SmallTriangle t(corners, range, kFixedOne);
  const std::int32_t nx = std::int32_t(range.size(0)), ny = std::int32_t(range.size(1)),
                     nz = std::int32_t(range.size(2));
  std::int64_t step[8];
  for (int i = 0; i < 6; ++i) step[i] = t.edges[3 + i].step[0];
  for (int i = 0; i < 2; ++i) step[6 + i] = t.plane[i].step[0];
  for (std::int32_t z = 0; z < nz; ++z) {
    for (std::int32_t y = 0; y < ny; ++y) {
      if ((t.edges[0].value(0, y, z) | t.edges[1].value(0, y, z) | t.edges[2].value(0, y, z)) < 0) continue;
      std::int64_t value[8];
      for (int i = 0; i < 6; ++i) value[i] = t.edges[3 + i].value(0, y, z);
      for (int i = 0; i < 2; ++i) value[6 + i] = t.plane[i].value(0, y, z);
      out.set_few(row_bits(value, step, nx), range.min[0], range.min[1] + y, range.min[2] + z);
    }
  }
}

/// The triangle lies between the cubes' faces along `thin`: only the projection along it decides.
template <class Rows>
void voxelize_flat(const Corners& corners, const CellRange& range, int thin, Rows& out) {
  const bool clockwise = normal_component<std::int64_t>(corners, thin) < 0;
  HalfSpace<std::int64_t> edges[3];
  std::int64_t step[3];
  for (int e = 0; e < 3; ++e) {
    edges[e] = edge_space<std::int64_t>(corners, e, thin, clockwise, range, kFixedOne);
    step[e] = edges[e].step[0];
  }
  for (std::int32_t z = 0; z < range.size(2); ++z) {
    for (std::int32_t y = 0; y < range.size(1); ++y) {
      std::int64_t value[3];
      for (int e = 0; e < 3; ++e) value[e] = edges[e].value(0, y, z);
      out.set_few(row_bits(value, step, std::int32_t(range.size(0))), range.min[0], range.min[1] + y, range.min[2] + z);
    }
  }
}

/// Works in blocks of kWideCells, so that the plane's values stay within 128 bits.
template <class Rows>
void voxelize_wide(const Corners& corners, const CellRange& range, Rows& out) {
  CellRange block;
  for (block.min[2] = range.min[2]; block.min[2] < range.max[2]; block.min[2] += kWideCells) {
    for (block.min[1] = range.min[1]; block.min[1] < range.max[1]; block.min[1] += kWideCells) {
      for (block.min[0] = range.min[0]; block.min[0] < range.max[0]; block.min[0] += kWideCells) {
        for (int i = 0; i < 3; ++i) block.max[i] = std::min(block.min[i] + kWideCells, range.max[i]);
        voxelize_rows<WideTriangle>(corners, block, out);
      }
    }
  }
}

VoxelBox box_of(const CellRange& range) {
  return {{std::int32_t(range.min[0]), std::int32_t(range.min[1]), std::int32_t(range.min[2])},
          {std::int32_t(range.max[0]), std::int32_t(range.max[1]), std::int32_t(range.max[2])}};
}

template <class Rows>
void voxelize_triangle(const FixedTriangle& triangle, std::int64_t slack, Rows& out) {
  const Corners corners(triangle, slack);
  const CellRange whole = voxel_range(corners), range = intersect(whole, out.box());
  if (range.empty()) return;
  const bool thin = int(whole.size(0) == 1) + int(whole.size(1) == 1) + int(whole.size(2) == 1) >= 2;
  if (settle_by_box(thin, box_of(range), out)) return;
  const std::int64_t extent = corners.extent();
  if (extent > kMediumExtent) return voxelize_wide(corners, range, out);
  if (extent > kSmallExtent) return voxelize_rows<MediumTriangle>(corners, range, out);
  for (int axis = 0; axis < 3; ++axis) {
    if (whole.size(axis) == 1) return voxelize_flat(corners, range, axis, out);
  }
  constexpr std::int64_t kFew = 64;
  if (range.size(0) * range.size(1) * range.size(2) <= kFew) return voxelize_few(corners, range, out);
  voxelize_rows<SmallTriangle>(corners, range, out);
}

}  // namespace

void voxelize_surface(std::span<const FixedTriangle> triangles, BitBox& out, std::int64_t slack) {
  if (out.box().empty()) return;
  BoxRows rows(out);
  for (const FixedTriangle& t : triangles) voxelize_triangle(t, slack, rows);
}

void voxelize_brick(const FixedTriangle& triangle, std::int64_t slack, SharedRows& out) {
  voxelize_triangle(triangle, slack, out);
}

namespace {

template <class Triangle>
void walk_tiles(const Corners& corners, const CellRange& range, std::int64_t edge,
                const std::function<void(TileCoord)>& emit) {
  Triangle t(corners, range, edge);
  // Beyond 2^40 units the plane's values could leave 128 bits: the edges alone decide.
  if (corners.extent() > (std::int64_t(1) << 40)) t.plane[0] = t.plane[1] = {};
  for_each_row(t, [&](std::int32_t x0, std::int32_t x1, std::int32_t y, std::int32_t z) {
    for (std::int32_t x = x0; x <= x1; ++x) {
      emit({std::int32_t(range.min[0]) + x, std::int32_t(range.min[1]) + y, std::int32_t(range.min[2]) + z});
    }
  });
}

}  // namespace

void for_each_tile(const FixedTriangle& triangle, VoxelCoord first, std::int32_t edge_vox, TileCoord count,
                   const std::function<void(TileCoord)>& emit, std::int64_t slack) {
  Corners corners(triangle, slack);
  const std::int64_t edge = std::int64_t(edge_vox) * kFixedOne;
  CellRange range;
  bool one = true;  // the triangle's box touches one tile
  for (int axis = 0; axis < 3; ++axis) {
    for (auto& p : corners.p) p[axis] -= std::int64_t(first[axis]) * kFixedOne;
    range.min[axis] = floor_div(corners.low(axis) - slack - 1, edge);
    range.max[axis] = floor_div(corners.high(axis) + slack, edge) + 1;
    if (range.size(axis) > 1) one = false;
    range.min[axis] = std::max<std::int64_t>(0, range.min[axis]);
    range.max[axis] = std::min<std::int64_t>(count[axis], range.max[axis]);
  }
  if (range.empty()) return;
  if (one) {
    emit({std::int32_t(range.min[0]), std::int32_t(range.min[1]), std::int32_t(range.min[2])});
  } else if (corners.extent() <= kMediumExtent && edge <= (std::int64_t(1) << 28)) {
    walk_tiles<MediumTriangle>(corners, range, edge, emit);
  } else {
    walk_tiles<WideTriangle>(corners, range, edge, emit);
  }
}

}  // namespace bp
