#pragma once
#include <algorithm>
#include <array>
#include <bit>

#include "lib/enclosed/enclosed.h"
#include "lib/grid/stream.h"
#include "lib/mesh/lattice_geometry.h"

namespace bp {

/// Separating axes of one tetrahedron against axis-aligned cubes: the cube's 3 face normals (its bounding box), the 4
/// face normals, and the 6 x 3 cross products of edges. Two convex bodies have disjoint interiors iff one of these axes
/// separates them weakly.
class Separator {
 public:
  explicit Separator(const Tetrahedron& t) : box_{t[0], t[0]} {
    for (const LatticeCoord& p : t) box_.add(p);
    for (std::size_t i = 0; i < 4; ++i) corners_[i] = t[i] - box_.min;
    const LatticeCoord side = box_.max - box_.min;
    reach_ = 2 * double(side.x + side.y + side.z) + 4 * double(kLargestCube);
    for (std::size_t skip = 0; skip < 4; ++skip)
      add_axis(normal_of(t[(skip + 1) % 4], t[(skip + 2) % 4], t[(skip + 3) % 4]));
  }

  [[nodiscard]] const LatticeBox& box() const { return box_; }

  /// True if the open cube [corner, corner + edge]^3, which meets the open box, and the open tetrahedron are disjoint.
  [[nodiscard]] bool separates(const LatticeCoord& corner, std::int64_t edge) {
    const LatticeCoord c = corner - box_.min;
    for (std::size_t a = 0; a < axes_.size(); ++a) {
      if (a == count_) {
        if (complete_) return false;
        add_edge_axes();
        if (a == count_) return false;
      }
      if (!separates_along(axes_[a], c, edge)) continue;
      last_ = a;
      return true;
    }
    return false;
  }

  /// Of a layer of cubes, bit 8 y + x the one at corner + (x, y, 0) edge, those that the axis that told the last cube
  /// apart leaves: few.
  [[nodiscard]] std::uint64_t left(std::uint64_t layer, const LatticeCoord& corner, std::int64_t edge) const {
    if (count_ == 0) return layer;
    const Axis& axis = axes_[last_];
    const LatticeCoord c = corner - box_.min;
    const double e = double(edge), step_x = axis.x * e, step_y = axis.y * e;
    const double at = axis.x * double(c.x) + axis.y * double(c.y) + axis.z * double(c.z);
    const double from = axis.max - axis.negative * e + 2 * axis.slack,
                 to = axis.min - axis.positive * e - 2 * axis.slack;
    std::uint64_t left = 0;
    for (std::uint64_t rest = layer; rest != 0; rest &= rest - 1) {
      const int bit = std::countr_zero(rest);
      const double there = at + step_x * (bit % 8) + step_y * (bit / 8);
      left |= std::uint64_t((there < from) & (there > to)) << bit;
    }
    return left;
  }

 private:
  static constexpr std::int64_t kLargestCube = std::int64_t(kBrickEdge) * kLatticePerVoxel;

  /// Coordinates are relative to the low corner of the tetrahedron's box. The doubles decide unless they are within
  /// rounding, which those of all but huge tetrahedra are free of.
  struct Axis {
    LatticeCoord n;
    double x, y, z;
    double negative, positive;  // sums of the negative and of the positive components: extent of a unit cube
    double min, max;            // of the tetrahedron
    double slack;               // a dozen roundings of terms below |n|_1 * reach_; 0: integers that doubles hold
  };

  [[nodiscard]] bool separates_along(const Axis& axis, const LatticeCoord& c, std::int64_t edge) const {
    const double at = axis.x * double(c.x) + axis.y * double(c.y) + axis.z * double(c.z), e = double(edge);
    const double over = std::max(at + axis.negative * e - axis.max, axis.min - (at + axis.positive * e));
    if (over < -axis.slack) return false;
    return over > axis.slack || axis.slack == 0 || separates_exactly(axis.n, c, edge);
  }

  [[nodiscard]] bool separates_exactly(const LatticeCoord& n, const LatticeCoord& c, std::int64_t edge) const {
    const auto along = [&](const LatticeCoord& p) { return int128(n.x) * p.x + int128(n.y) * p.y + int128(n.z) * p.z; };
    int128 min = along(corners_[0]), max = min, low = along(c), high = low;
    for (const LatticeCoord& p : corners_) {
      min = std::min(min, along(p));
      max = std::max(max, along(p));
    }
    for (int i = 0; i < 3; ++i) (n[i] < 0 ? low : high) += int128(n[i]) * edge;
    return low >= max || high <= min;
  }

  /// The faces' normals tell nearly all cubes apart: the others wait until one asks.
  void add_edge_axes() {
    complete_ = true;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i + 1; j < 4; ++j) {
        const LatticeCoord e = corners_[j] - corners_[i];
        add_axis({0, e.z, -e.y});
        add_axis({-e.z, 0, e.x});
        add_axis({e.y, -e.x, 0});
      }
    }
  }

  void add_axis(const LatticeCoord& n) {
    if (n == LatticeCoord{}) return;
    Axis axis{n, double(n.x), double(n.y), double(n.z), 0, 0, 0, 0, 0};
    for (int i = 0; i < 3; ++i) (n[i] < 0 ? axis.negative : axis.positive) += double(n[i]);
    for (std::size_t i = 0; i < 4; ++i) {
      const double at =
          axis.x * double(corners_[i].x) + axis.y * double(corners_[i].y) + axis.z * double(corners_[i].z);
      axis.min = i == 0 ? at : std::min(axis.min, at);
      axis.max = i == 0 ? at : std::max(axis.max, at);
    }
    const double bound = (axis.positive - axis.negative) * reach_;
    axis.slack = bound < 0x1p52 ? 0 : 0x1p-49 * bound;
    axes_[count_++] = axis;
  }

  Tetrahedron corners_;  // relative to box_.min
  double reach_;         // bounds the sum of sizes of the coordinates of a corner, of either body
  LatticeBox box_;
  std::array<Axis, 22> axes_;
  std::size_t count_ = 0, last_ = 0;  // the one that told the last cube apart often does the next
  bool complete_ = false;             // the edges' axes are there
};

}  // namespace bp
