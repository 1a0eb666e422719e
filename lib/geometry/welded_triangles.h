#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "lib/core/coords.h"

namespace bp {

/// Triangles as numbers of places. Corners at the same place have the same number.
struct WeldedTriangles {
  std::vector<Vec3d> places;                            ///< distinct, in ascending order
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< as many as were given, in their order
};

/// Merges corners whose coordinates are equal. Fewer than 2^32 / 3 triangles. O(n log n), parallel.
[[nodiscard]] WeldedTriangles welded(std::span<const TriangleD> triangles);

constexpr std::uint32_t kNoTwin = ~std::uint32_t(0);
/// Returns for each half-edge 3 f + k, from corner k of triangle f to the next one, the other half of its edge: kNoTwin
/// unless the edge belongs to exactly two triangles, in opposite directions, or if both ends are one place. O(n log n),
/// parallel.
[[nodiscard]] std::vector<std::uint32_t> twins_of(std::span<const std::array<std::uint32_t, 3>> triangles);

}  // namespace bp
