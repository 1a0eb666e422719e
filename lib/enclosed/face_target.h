#pragma once
#include <array>

#include "lib/core/vec3.h"

namespace bp {

/// Returns the squared distance of p from the triangle.
[[nodiscard]] double squared_distance(const Vec3d& p, const std::array<Vec3d, 3>& t);

/// A face that points may be nearest to: its plane, and three planes upright on it along its edges, positive outwards.
/// The distances from these planes are lower bounds of the distance from the face.
class FaceTarget {
 public:
  FaceTarget() = default;
  explicit FaceTarget(const std::array<Vec3d, 3>& corners);
  [[nodiscard]] double squared_distance(const Vec3d& p) const;
  /// Returns true if p is surely as far as `squared` or farther, but for rounding. False tells nothing.
  [[nodiscard]] bool is_farther(const Vec3d& p, double squared) const {
    const double above = planes_[3].height(p), rest = squared - above * above;
    if (rest <= 0) return true;
    for (std::size_t k = 0; k < 3; ++k) {
      const double beside = planes_[k].height(p);
      if (beside > 0 && beside * beside >= rest) return true;
    }
    return false;
  }
  /// Returns whether everything beyond the planes along its edges is farther from p than the squared distance given.
  [[nodiscard]] bool is_inner(const Vec3d& p, double squared) const {
    for (std::size_t k = 0; k < 3; ++k) {
      const double beside = planes_[k].height(p);
      if (beside > 0 || beside * beside < squared) return false;
    }
    return true;
  }

 private:
  struct Plane {
    Vec3d normal;
    double offset;
    [[nodiscard]] double height(const Vec3d& p) const { return dot(normal, p) - offset; }
  };
  std::array<Vec3d, 3> corners_;
  std::array<Plane, 4> planes_;  // three along the edges, then the face's own
};

}  // namespace bp
