#pragma once
#include <algorithm>
#include <cstdint>

#include "lib/core/box.h"
#include "lib/voxel/fixed_triangle.h"

/// Exact triangle-cube overlap in integers, after Schwarz and Seidel 2010 ([SS10], docs/references.md): the separating
/// axes of a triangle and a cube, as half-spaces that are linear in the cube's index. Cells are the cubes of a regular
/// grid (voxels, or tiles) with corners at multiples of `edge`; each is grown by the slack and closed.
///
/// A cell (x, y, z) meets the triangle if and only if it lies in TriangleCells::range and all eleven half-spaces hold
/// there:
///   edges  one per edge and coordinate plane: the projected cell reaches the inner side of the projected edge
///   plane  the cell reaches both sides of the triangle's plane
/// Where a projection has no area its edges run both ways along one line, so that they bound it from both sides
/// whatever the orientation; where the triangle has no area the plane's half-spaces hold everywhere. Degenerate
/// triangles need no case of their own.
///
/// Integer types by the triangle's extent (largest side of its box), with all values bounded below 2^63 or 2^127:
///   EdgeInt: |normal| <= extent, |corner - vertex| <= extent + edge + 2 kMostFixedSlack, two terms
///   PlaneInt: |normal| <= 2 extent^2, three terms
///   small   extent <= 2^20 (16 voxels), edge 2^16     edges 64 bits (2^41.2), plane 64 bits (6.6 * 2^60)
///   medium  extent <= 2^30, edge <= 2^28              edges 64 bits (2^61.4), plane 128 bits
///   wide    any, extent < 2^48                        edges 128 bits (2^97); plane see WidePlane below
namespace bp {

__extension__ typedef __int128 Int128;

constexpr std::int64_t kSmallExtent = std::int64_t(1) << 20;
constexpr std::int64_t kMediumExtent = std::int64_t(1) << 30;

/// The cells with at + step . cell >= 0, counted from the first cell of the range.
template <class Int>
struct HalfSpace {
  Int at{};
  Int step[3]{};
  [[nodiscard]] Int value(std::int32_t x, std::int32_t y, std::int32_t z) const {
    return at + step[0] * x + step[1] * y + step[2] * z;
  }
};

/// Half-open range of cells.
struct CellRange {
  std::int64_t min[3], max[3];
  [[nodiscard]] bool empty() const { return min[0] >= max[0] || min[1] >= max[1] || min[2] >= max[2]; }
  [[nodiscard]] std::int64_t size(int axis) const { return max[axis] - min[axis]; }
};

/// A triangle as arrays, for loops over axes.
struct Corners {
  std::int64_t p[3][3];
  std::int64_t slack;  ///< that cells are grown by, at most kMostFixedSlack
  explicit Corners(const FixedTriangle& t, std::int64_t grown_by = kFixedSlack)
      : p{{t.a.x, t.a.y, t.a.z}, {t.b.x, t.b.y, t.b.z}, {t.c.x, t.c.y, t.c.z}}, slack(grown_by) {}
  [[nodiscard]] std::int64_t low(int axis) const { return std::min(std::min(p[0][axis], p[1][axis]), p[2][axis]); }
  [[nodiscard]] std::int64_t high(int axis) const { return std::max(std::max(p[0][axis], p[1][axis]), p[2][axis]); }
  [[nodiscard]] std::int64_t extent() const {
    std::int64_t e = 0;
    for (int axis = 0; axis < 3; ++axis) e = std::max(e, high(axis) - low(axis));
    return e;
  }
};

/// Voxels whose closed, grown cubes meet the triangle's box.
[[nodiscard]] inline CellRange voxel_range(const Corners& t) {
  CellRange r{};
  for (int axis = 0; axis < 3; ++axis) {
    r.min[axis] = (t.low(axis) - t.slack - 1) >> kFixedBits;
    r.max[axis] = ((t.high(axis) + t.slack) >> kFixedBits) + 1;
  }
  return r;
}

/// n . p saturated to +-2^126, without overflow: |n| < 2^96, |p| < 2^49.
[[nodiscard]] inline Int128 saturated_dot(const Int128 n[3], const std::int64_t p[3]) {
  Int128 high = 0, low = 0;  // sum = high * 2^48 + low
  for (int axis = 0; axis < 3; ++axis) {
    high += (n[axis] >> 48) * p[axis];
    low += (n[axis] & ((Int128(1) << 48) - 1)) * p[axis];
  }
  high += low >> 48;
  low &= (Int128(1) << 48) - 1;
  const Int128 limit = Int128(1) << 126;
  if (high >= (limit >> 48)) return limit;
  if (high < -(limit >> 48)) return -limit;
  return high * (Int128(1) << 48) + low;
}
[[nodiscard]] inline std::int64_t saturated_dot(const std::int64_t n[3], const std::int64_t p[3]) {
  return n[0] * p[0] + n[1] * p[1] + n[2] * p[2];
}

/// Returns the corner, grown, of the range's first cell that lies farthest along a normal with this sign.
[[nodiscard]] inline std::int64_t far_corner(const Corners& t, const CellRange& range, int axis, bool positive,
                                             std::int64_t edge) {
  return range.min[axis] * edge + (positive ? edge + t.slack : -t.slack);
}

/// Returns component w of the triangle's normal: twice the signed area of the projection along w.
template <class Int>
[[nodiscard]] inline Int normal_component(const Corners& t, int w) {
  const int u = (w + 1) % 3, v = (w + 2) % 3;
  return Int(t.p[1][u] - t.p[0][u]) * (t.p[2][v] - t.p[1][v]) - Int(t.p[1][v] - t.p[0][v]) * (t.p[2][u] - t.p[1][u]);
}

/// Half-space of edge e, projected along w; `clockwise`: normal_component(t, w) < 0.
template <class Int>
[[nodiscard]] inline HalfSpace<Int> edge_space(const Corners& t, int e, int w, bool clockwise, const CellRange& range,
                                               std::int64_t edge) {
  const int u = (w + 1) % 3, v = (w + 2) % 3;
  const std::int64_t* from = t.p[e];
  const std::int64_t* to = t.p[(e + 1) % 3];
  const std::int64_t du = to[u] - from[u], dv = to[v] - from[v];
  const Int nu = clockwise ? dv : -dv, nv = clockwise ? -du : du;  // points inward
  HalfSpace<Int> h;
  h.at =
      nu * (far_corner(t, range, u, nu > 0, edge) - from[u]) + nv * (far_corner(t, range, v, nv > 0, edge) - from[v]);
  h.step[u] = nu * edge;
  h.step[v] = nv * edge;
  return h;
}

/// Half-space of the cells that reach the side of the triangle's plane to which `normal` points.
template <class Int>
[[nodiscard]] inline HalfSpace<Int> plane_space(const Corners& t, const Int normal[3], const CellRange& range,
                                                std::int64_t edge) {
  HalfSpace<Int> h;
  std::int64_t reach[3];
  for (int axis = 0; axis < 3; ++axis) {
    reach[axis] = far_corner(t, range, axis, normal[axis] > 0, edge) - t.p[0][axis];
    h.step[axis] = normal[axis] * edge;
  }
  h.at = saturated_dot(normal, reach);
  return h;
}

/// The half-spaces of one triangle over a range of cells.
template <class EdgeInt, class PlaneInt>
struct TriangleCells {
  CellRange range;
  HalfSpace<EdgeInt> edges[9];  ///< 3 w + e: projection along axis w, edge e
  HalfSpace<PlaneInt> plane[2];

  /// `range`: the cells asked about, all of which meet the triangle's box.
  TriangleCells(const Corners& t, const CellRange& cells, std::int64_t edge) : range(cells) {
    PlaneInt normal[3], opposite[3];
    for (int w = 0; w < 3; ++w) {
      normal[w] = normal_component<PlaneInt>(t, w);
      opposite[w] = -normal[w];
      for (int e = 0; e < 3; ++e) edges[3 * w + e] = edge_space<EdgeInt>(t, e, w, normal[w] < 0, range, edge);
    }
    plane[0] = plane_space(t, normal, range, edge);
    plane[1] = plane_space(t, opposite, range, edge);
  }

  /// True if the cell, counted from range.min, meets the triangle.
  [[nodiscard]] bool meets(std::int32_t x, std::int32_t y, std::int32_t z) const {
    for (const auto& h : edges) {
      if (h.value(x, y, z) < 0) return false;
    }
    return plane[0].value(x, y, z) >= 0 && plane[1].value(x, y, z) >= 0;
  }
};

using SmallTriangle = TriangleCells<std::int64_t, std::int64_t>;
using MediumTriangle = TriangleCells<std::int64_t, Int128>;
/// WidePlane: |normal| < 2^97 in theory, < 2^95 + 2^95 for grids of 2^31 voxels. Over a range of at most
/// kWideCells voxels a side the values vary by less than 3 * 2^96 * 2^16 * 2^11 < 2^125, so a value saturated to
/// +-2^126 keeps its sign all over the range.
using WideTriangle = TriangleCells<Int128, Int128>;
constexpr std::int64_t kWideCells = 2048;

/// Shrinks [low, high] to the i with at + step * i >= 0. False if none is left. An estimate in doubles, corrected in
/// integers: exact whatever the estimate.
template <class Int>
[[nodiscard]] inline bool clip(Int at, Int step, std::int32_t& low, std::int32_t& high) {
  const Int at_low = at + step * low, at_high = at + step * high;
  if (at_low >= 0 && at_high >= 0) return true;
  if (at_low < 0 && at_high < 0) return false;
  std::int32_t i = low + std::int32_t(double(at_low) / -double(step));  // the sign changes at, or next to, i
  if (i > high) i = high;
  if (at_low < 0) {
    while (at + step * i < 0) ++i;
    while (at + step * (i - 1) >= 0) --i;
    low = i;
  } else {
    while (at + step * i < 0) --i;
    while (i < high && at + step * (i + 1) >= 0) ++i;
    high = i;
  }
  return true;
}

}  // namespace bp
