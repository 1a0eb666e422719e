#pragma once
#include <algorithm>

#include "lib/core/box.h"

namespace bp {

/// A part of a scene that has a small share of its area, lies far from the rest, and makes the bounds large.
struct StrayPart {
  Bounds3d part, rest;  ///< scene units
  double share = 0;     ///< share of the area

  /// Returns whether a triangle of the scene belongs to the part. If the part lies at both ends of the scene, its
  /// bounds may hold the rest, too.
  [[nodiscard]] bool holds(const TriangleD& t) const {
    const auto lies_in = [&](const Bounds3d& b) {
      return std::all_of(t.begin(), t.end(), [&](const Vec3d& p) {
        for (std::size_t i = 0; i < 3; ++i) {
          if (!(p[i] >= b.min[i] && p[i] <= b.max[i])) return false;
        }
        return true;
      });
    };
    return lies_in(part) && !lies_in(rest);
  }
};
constexpr double kStrayShare = 0.01;  ///< largest share of the area
constexpr double kStrayStretch = 4;   ///< the bounds are longer than those of the rest by more than this factor

}  // namespace bp
