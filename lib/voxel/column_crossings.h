#pragma once
#include "lib/grid/bit_box.h"
#include "lib/voxel/crossing.h"
#include "lib/voxel/overlap.h"

/// Where the columns of a tile cross one triangle: the inner step of find_crossings.
///
/// Bounds of the integers, with E the triangle's extent. A column inside the triangle lies within E of each vertex.
///   EdgeInt: two products of E and E                           64 bits up to E = 2^30, else 128
///   PlaneInt: the normal (2 E^2) times E, three terms: 6 E^3   64 bits up to E = 2^20, 128 up to 2^41
namespace bp {

constexpr std::int64_t kFixedHalf = kFixedOne / 2;

/// First and last voxel whose centre lies in [low, high], along one axis.
[[nodiscard]] inline std::int64_t first_centre(std::int64_t low) {
  return (low - kFixedHalf + kFixedOne - 1) >> kFixedBits;
}
[[nodiscard]] inline std::int64_t last_centre(std::int64_t high) {
  return (high - kFixedHalf) >> kFixedBits;
}

/// Iterates over the crossings of one triangle with the columns of a tile.
template <class EdgeInt, class PlaneInt>
class ColumnCrossings {
 public:
  ColumnCrossings(const Corners& t, const VoxelBox& tile) : tile_(tile) {
    for (int axis = 0; axis < 3; ++axis) {
      corner_[axis] = t.p[0][axis];
      normal_[axis] = normal_component<PlaneInt>(t, axis);
    }
    const bool clockwise = normal_[2] < 0;
    down_ = clockwise;
    if (clockwise) {
      for (PlaneInt& n : normal_) n = -n;  // up
    }
    x0_ = std::max<std::int64_t>(first_centre(t.low(0)), tile.min.x);
    y0_ = std::max<std::int64_t>(first_centre(t.low(1)), tile.min.y);
    const std::int64_t x1 = std::min<std::int64_t>(last_centre(t.high(0)), tile.max.x - 1),
                       y1 = std::min<std::int64_t>(last_centre(t.high(1)), tile.max.y - 1);
    if (normal_[2] == 0 || x0_ > x1 || y0_ > y1) return;  // no rows
    width_ = std::int32_t(x1 - x0_) + 1;
    row_count_ = std::int32_t(y1 - y0_) + 1;
    row_ = -1;
    for (int e = 0; e < 3; ++e) edges_[e] = edge(t, e, clockwise);
  }

  /// Finds the next crossing that lies in the tile; returns false if there is none left.
  bool next(Crossing& out) {
    for (;;) {
      while (column_ > last_) {
        if (++row_ >= row_count_) return false;
        begin_row();
      }
      const std::int64_t x = x0_ + column_++, y = y0_ + row_;
      if (cross(x, y, out)) return true;
    }
  }

 private:
  /// Returns the columns on the inner side of edge e of the projection along z, counted from (x0_, y0_).
  HalfSpace<EdgeInt> edge(const Corners& t, int e, bool clockwise) const {
    const std::int64_t* from = t.p[clockwise ? (e + 1) % 3 : e];
    const std::int64_t* to = t.p[clockwise ? e : (e + 1) % 3];
    const EdgeInt dx = to[0] - from[0], dy = to[1] - from[1];
    // The shift by (e, e^2) adds dx e^2 - dy e, which decides for a column that lies on the edge's line.
    const bool on_line_is_inside = dy < 0 || (dy == 0 && dx > 0);
    HalfSpace<EdgeInt> h;
    h.at = dx * (y0_ * kFixedOne + kFixedHalf - from[1]) - dy * (x0_ * kFixedOne + kFixedHalf - from[0]) -
           (on_line_is_inside ? 0 : 1);
    h.step[0] = -dy * kFixedOne;
    h.step[1] = dx * kFixedOne;
    return h;
  }

  void begin_row() {
    std::int32_t first = 0, last = width_ - 1;
    bool any = true;
    for (int e = 0; e < 3 && any; ++e) any = clip(edges_[e].value(0, row_, 0), edges_[e].step[0], first, last);
    column_ = first;
    last_ = any ? last : -1;
  }

  /// Height above the corner: -(nx dx + ny dy) / nz, exact; then in half voxels above the grid, rounded down and up.
  bool cross(std::int64_t x, std::int64_t y, Crossing& out) const {
    const std::int64_t dx = x * kFixedOne + kFixedHalf - corner_[0], dy = y * kFixedOne + kFixedHalf - corner_[1];
    // corner z = whole half voxels + rest keeps the products small.
    const std::int64_t whole = corner_[2] >> (kFixedBits - 1), rest = corner_[2] & (kFixedHalf - 1);
    const PlaneInt value = normal_[2] * rest - (normal_[0] * dx + normal_[1] * dy), half_step = normal_[2] * kFixedHalf;
    const PlaneInt halves = floor_div(value, half_step);
    const std::int64_t below = whole + std::int64_t(halves), up = below + (halves * half_step == value ? 0 : 1);
    if ((below >> 1) < tile_.min.z || (below >> 1) >= tile_.max.z) return false;
    out.x = std::uint32_t(x - tile_.min.x) & 511;
    out.y = std::uint32_t(y - tile_.min.y) & 511;
    out.z = std::uint32_t((up >> 1) - tile_.min.z) & 1023;
    out.down = down_ ? 1 : 0;
    return true;
  }

  VoxelBox tile_;
  std::int64_t corner_[3];
  PlaneInt normal_[3];
  HalfSpace<EdgeInt> edges_[3];
  std::int64_t x0_, y0_;  ///< first column and row of the triangle's box
  bool down_;
  std::int32_t width_ = 0, row_count_ = 0, row_ = 0, column_ = 0, last_ = -1;
};

}  // namespace bp
