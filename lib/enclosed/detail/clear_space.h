#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "lib/core/vec3.h"
#include "lib/enclosed/eight_triangles.h"

namespace bp {

/// A half-space that lies clear of a body: it holds the points p, as rounded, with n . p > limit. A triangle in it does
/// not meet the body, whatever n is.
struct ClearSpace {
  std::array<float, 3> n;
  float limit;

  /// Bit k is set if the half-space holds the corners of triangle k, from the first to number `last`.
  [[nodiscard]] std::uint32_t holds(const EightTriangles& eight, std::size_t last) const {
    const auto beyond = [&](std::size_t half) {
      FourInts all{-1, -1, -1, -1};
      for (std::size_t k = 0; k <= last; ++k) {
        const auto& c = eight.corners[k];
        all &= n[0] * c[0][half] + n[1] * c[1][half] + n[2] * c[2][half] > limit;
      }
      return all;
    };
    return bits_of(beyond(0), beyond(1));
  }
};

/// Returns the half-space beyond `body` in this direction, and beyond all that is within `around` of it, lattice units.
/// `body` is relative to the tree's base. Rounding, with sizes of n that sum to 1: each of the three terms of n . p
/// passes through at most 6 roundings of floats (n, p, the product, two sums), the limit through 2, so the height errs
/// by less than 14 roundings of reach or limit; to_voxels errs by less than 2^-14 lattice units.
inline ClearSpace beyond(const Vec3d& direction, std::span<const Vec3d> body, double reach, double around = 0) {
  const double size = std::abs(direction[0]) + std::abs(direction[1]) + std::abs(direction[2]);
  if (!(size > 0)) return {{0, 0, 0}, 1};
  const Vec3d n = (1 / size) * direction;
  double limit = dot(n, body[0]);
  for (const Vec3d& p : body) limit = std::max(limit, dot(n, p));
  limit += around;
  return {{float(n[0]), float(n[1]), float(n[2])}, float(limit + 0x1p-12 + 0x1p-20 * (reach + std::abs(limit)))};
}

}  // namespace bp
