#pragma once
#include <algorithm>
#include <array>
#include <bit>

#include "lib/enclosed/enclosed.h"
#include "lib/grid/stream.h"
#include "lib/mesh/lanes.h"
#include "lib/mesh/lattice_geometry.h"

namespace bp {

/// Four axes, tested side by side in floats, for whether a tetrahedron lies apart from cubes. A cube that is reported
/// apart is apart; others may be, too. Coordinates are relative to the low corner of the tetrahedron's box.
class FourAxes {
 public:
  /// `normals`: an axis of 0 separates nothing. `sides`: the sum of the sides of the tetrahedron's box.
  FourAxes(const std::array<LatticeCoord, 4>& normals, const Tetrahedron& corners, double sides) : sides_(sides) {
    for (std::size_t k = 0; k < 4; ++k) {
      const LatticeCoord& n = normals[k];
      n_[0][k] = float(n.x);
      n_[1][k] = float(n.y);
      n_[2][k] = float(n.z);
    }
    for (const FourFloats& n : n_) {
      positive_ += n > 0 ? n : FourFloats{};
      negative_ += n > 0 ? FourFloats{} : n;
    }
    slack_ = 0x1p-19F * (positive_ - negative_);  // 32 roundings
    min_ = max_ = along(corners[0]);
    for (std::size_t i = 1; i < 4; ++i) {
      const FourFloats at = along(corners[i]);
      min_ = at < min_ ? at : min_;
      max_ = at > max_ ? at : max_;
    }
  }

  /// Returns those cubes of a layer that no axis separates. `layer`: bit 8 y + x stands for the cube at corner + (x, y,
  /// 0) edge; the cubes meet the tetrahedron's box.
  [[nodiscard]] std::uint64_t left(std::uint64_t layer, const LatticeCoord& corner, std::int64_t edge) const {
    const auto e = float(edge);
    // No coordinate is larger than this reach R. Each term of the cube's side of a comparison passes through at most 10
    // roundings, of the tetrahedron's through 7, and the terms of a side sum to |n|_1 R at most: 17 of the 32 above.
    const FourFloats slack = slack_ * float(sides_ + 8 * double(edge));
    const FourFloats from = max_ - negative_ * e + slack, to = min_ - positive_ * e - slack;
    const FourFloats at = along(corner), step_x = n_[0] * e, step_y = n_[1] * e;
    std::uint64_t left = 0;
    for (std::uint64_t rest = layer; rest != 0; rest &= rest - 1) {
      const int bit = std::countr_zero(rest);
      const FourFloats there = at + step_x * float(bit % 8) + step_y * float(bit / 8);
      left |= std::uint64_t(!any((there > from) | (there < to))) << bit;
    }
    return left;
  }

 private:
  [[nodiscard]] FourFloats along(const LatticeCoord& p) const {
    return n_[0] * float(p.x) + n_[1] * float(p.y) + n_[2] * float(p.z);
  }

  std::array<FourFloats, 3> n_{};
  FourFloats positive_{}, negative_{};  // sums of the positive and of the negative components: extent of a unit cube
  FourFloats min_, max_;                // extent of the tetrahedron along each axis
  FourFloats slack_;                    // rounding error for a reach of 1
  double sides_;
};

/// Separating axes of one tetrahedron against axis-aligned cubes: the cube's 3 face normals (its bounding box), the 4
/// face normals, and the 6 x 3 cross products of edges. Two convex bodies have disjoint interiors iff one of these axes
/// separates them weakly.
class Separator {
 public:
  explicit Separator(const Tetrahedron& t)
      : box_(box_of(t)),
        corners_{t[0] - box_.min, t[1] - box_.min, t[2] - box_.min, t[3] - box_.min},
        sides_(sum_of_sides(box_)),
        normals_{normal_of(t[1], t[2], t[3]), normal_of(t[2], t[3], t[0]), normal_of(t[3], t[0], t[1]),
                 normal_of(t[0], t[1], t[2])},
        faces_(normals_, corners_, sides_) {}

  [[nodiscard]] const LatticeBox& box() const { return box_; }

  /// Returns those cubes of a layer (as FourAxes::left()) that the face normals do not surely separate from the
  /// tetrahedron: few.
  [[nodiscard]] std::uint64_t left(std::uint64_t layer, const LatticeCoord& corner, std::int64_t edge) const {
    return layer == 0 ? 0 : faces_.left(layer, corner - box_.min, edge);
  }

  /// True if the open cube [corner, corner + edge]^3, which meets the open box, and the open tetrahedron are disjoint.
  [[nodiscard]] bool separates(const LatticeCoord& corner, std::int64_t edge) {
    if (count_ == 0) {
      for (const LatticeCoord& n : normals_) add_axis(n);
    }
    const LatticeCoord c = corner - box_.min;
    for (std::size_t a = 0; a < axes_.size(); ++a) {
      if (a == count_) {
        if (complete_) return false;
        add_edge_axes();
        if (a == count_) return false;
      }
      if (separates_along(axes_[a], c, edge)) return true;
    }
    return false;
  }

 private:
  static double sum_of_sides(const LatticeBox& box) {
    const LatticeCoord side = box.max - box.min;
    return double(side.x + side.y + side.z);
  }

  /// An axis. Coordinates are relative to the low corner of the tetrahedron's box. Doubles decide, unless the values
  /// are within rounding, which happens only for huge tetrahedra.
  struct Axis {
    LatticeCoord n;
    double x, y, z;
    double negative, positive;  // sums of the negative and of the positive components: extent of a unit cube
    double min, max;            // extent of the tetrahedron
    double slack;  // a dozen roundings of terms below |n|_1 * reach_; 0: the values are integers that doubles hold
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

  /// Adds the axes of the edges. The faces' normals separate nearly all cubes, so these are made when a cube first
  /// needs them.
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
    constexpr std::int64_t kLargestCube = std::int64_t(kBrickEdge) * kLatticePerVoxel;
    // An upper bound for the sum of sizes of the coordinates of a corner, of either body.
    const double bound = (axis.positive - axis.negative) * (2 * sides_ + 4 * double(kLargestCube));
    axis.slack = bound < 0x1p52 ? 0 : 0x1p-49 * bound;
    axes_[count_++] = axis;
  }

  LatticeBox box_;
  Tetrahedron corners_;  // relative to box_.min
  double sides_;
  std::array<LatticeCoord, 4> normals_;  // of the faces
  FourAxes faces_;
  std::array<Axis, 22> axes_;
  std::size_t count_ = 0;
  bool complete_ = false;  // the edges' axes are there
};

}  // namespace bp
