#pragma once
#include <algorithm>

#include "lib/core/box.h"

namespace bp {

/// A small part of a scene, by area, that lies far from the rest and makes the bounds large.
struct StrayPart {
  Bounds3d part, rest;  ///< scene units
  double share = 0;     ///< of the area

  /// Whether a triangle of the scene belongs to the part. Pieces at both ends of the scene have bounds that may hold
  /// the rest, too.
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
constexpr double kStrayShare = 0.01;  ///< of the area, at most
constexpr double kStrayStretch = 4;   ///< the bounds are longer than those of the rest by more than this factor

}  // namespace bp
