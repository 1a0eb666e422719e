#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "lib/core/coords.h"

namespace bp {

/// Triangles by numbers of places: corners at the same place have the same number.
struct WeldedTriangles {
  std::vector<Vec3d> places;                            ///< distinct, in ascending order
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< as many as were given, in their order
};

/// Merges corners whose coordinates are equal. Fewer than 2^32 / 3 triangles. O(n log n).
[[nodiscard]] WeldedTriangles welded(std::span<const TriangleD> triangles);

}  // namespace bp
