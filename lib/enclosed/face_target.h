#pragma once
#include <array>

#include "lib/core/vec3.h"

namespace bp {

/// Squared distance of p from the triangle.
[[nodiscard]] double squared_distance(const Vec3d& p, const std::array<Vec3d, 3>& t);

/// A face that points may be nearest to: its plane, and upright on it those along its edges, outwards positive. Their
/// distances bound that of the face from below.
class FaceTarget {
 public:
  FaceTarget() = default;
  explicit FaceTarget(const std::array<Vec3d, 3>& corners);
  [[nodiscard]] double squared_distance(const Vec3d& p) const;
  /// As far or farther, surely but for rounding; false: it may be.
  [[nodiscard]] bool is_farther(const Vec3d& p, double squared) const {
    const double above = planes_[3].height(p), rest = squared - above * above;
    if (rest <= 0) return true;
    for (std::size_t k = 0; k < 3; ++k) {
      const double beside = planes_[k].height(p);
      if (beside > 0 && beside * beside >= rest) return true;
    }
    return false;
  }
  /// Whether all that lies beyond the planes along its edges is farther from p, which is at the squared distance given.
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
  std::array<Plane, 4> planes_;  // along the edges, then its own
};

}  // namespace bp
