#pragma once
#include <array>
#include <cmath>
#include <optional>

#include "lib/core/grid_frame.h"
#include "lib/core/vec3.h"
#include "lib/enclosed/enclosed.h"
#include "lib/exact/predicates.h"

namespace bp {

/// A closed tetrahedron, turned so that each of its four planes has the inside on its negative side: corners
/// (q, b, c, a) of a swept one, so that the plane of the first three is that of the new face.
class Solid {
 public:
  Solid(const GridFrame& frame, const Tetrahedron& lattice) : lattice_(lattice) {
    for (std::size_t i = 0; i < 4; ++i) corners_[i] = frame.world(lattice[i]);
  }
  [[nodiscard]] const Tetrahedron& lattice() const { return lattice_; }
  [[nodiscard]] bool holds(const Vec3d& p) const {  ///< exact
    const auto& [a, b, c, d] = corners_;
    return orient3d(a, b, c, p) <= 0 && orient3d(a, d, b, p) <= 0 && orient3d(b, d, c, p) <= 0 &&
           orient3d(c, d, a, p) <= 0;
  }
  /// True unless every point within 1/64 of a lattice unit of `p`, lattice units, is surely outside.
  [[nodiscard]] bool may_hold(const Vec3d& p) const {
    constexpr double kSlack = 1.0 / 64;
    const Vec3d base = to_double(lattice_[0]);
    std::array<Vec3d, 4> c;
    for (std::size_t i = 0; i < 4; ++i) c[i] = to_double(lattice_[i]) - base;
    const Vec3d point = p - base;
    const auto beyond = [&](std::size_t i, std::size_t j, std::size_t k) {
      const Vec3d n = cross(c[j] - c[i], c[k] - c[i]);
      return dot(n, point - c[i]) > kSlack * (std::abs(n[0]) + std::abs(n[1]) + std::abs(n[2]));
    };
    return !beyond(0, 1, 2) && !beyond(0, 3, 1) && !beyond(1, 3, 2) && !beyond(2, 3, 0);
  }

 private:
  Tetrahedron lattice_;
  std::array<Vec3d, 4> corners_;
};

/// Returns the solid of a swept tetrahedron (a, b, c, q), whose q is on the inner side of its old face; none for a flat
/// one, which holds nothing.
inline std::optional<Solid> solid_of(const GridFrame& frame, const Tetrahedron& t) {
  const int turn = orient3d(t[0], t[1], t[2], t[3]);
  if (turn == 0) return std::nullopt;
  const std::size_t second = turn > 0 ? 1 : 2;
  return Solid(frame, {t[3], t[second], t[3 - second], t[0]});
}

/// Returns whether the face is the new face over the swept tetrahedron.
inline bool closes(const NewFace& f, const Tetrahedron& t) {
  return f.corners[0] == t[3] && f.corners[1] == t[1] && f.corners[2] == t[2];
}

}  // namespace bp
