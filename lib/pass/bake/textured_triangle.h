#pragma once
#include <cmath>

#include "lib/core/box.h"
#include "lib/core/color.h"
#include "lib/core/texture.h"
#include "lib/core/vec3.h"

namespace bp {

struct TexturedTriangle {
  TriangleD corners;
  TriangleColors colors;
  TriangleTexture texture;
};

[[nodiscard]] inline Vec3d middle_of(const TriangleD& t) {
  Vec3d p;
  for (std::size_t i = 0; i < 3; ++i) p[i] = t[0][i] / 3 + t[1][i] / 3 + t[2][i] / 3;
  return p;
}

/// Returns the texels of an image of this size along a length of 1 on a triangle; 0 if that is unknown.
[[nodiscard]] inline double texels_per_unit(const TriangleD& t, const TriangleTexture& texture,
                                            const std::array<int, 2>& size) {
  const auto& [a, b, c] = texture.uv;
  const double flat =
      std::abs((double(b[0]) - a[0]) * (double(c[1]) - a[1]) - (double(c[0]) - a[0]) * (double(b[1]) - a[1]));
  const double area = length(cross(t[1] - t[0], t[2] - t[0]));
  const double texels = std::sqrt(flat * size[0] * size[1] / area);
  return std::isfinite(texels) ? texels : 0;
}

/// Returns the place of a point of `bounds` along a curve that mostly goes from neighbour to neighbour (Morton order),
/// up to 2^57.
[[nodiscard]] inline std::uint64_t morton_of(const Vec3d& p, const Bounds3d& bounds) {
  constexpr int kBits = 19;
  std::uint64_t code = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double part = (p[i] - bounds.min[i]) / (bounds.max[i] - bounds.min[i]);  // NaN if the bounds are flat
    const auto x = std::uint64_t(part > 0 ? std::min(part, 1.0) * ((1 << kBits) - 1) : 0);
    for (int bit = 0; bit < kBits; ++bit) code |= (x >> bit & 1) << (3 * bit + int(i));
  }
  return code;
}

}  // namespace bp
