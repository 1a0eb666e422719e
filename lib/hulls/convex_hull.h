#pragma once
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "lib/core/coords.h"
#include "lib/exact/predicates.h"

/// Convex hulls of lattice points, exact.
namespace bp {

struct ConvexHull {
  std::vector<LatticeCoord> vertices;                   ///< corners of the hull only, each once
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< outward, closed, 2-manifold
};

/// The hull of points that span less than 2^29 lattice units along each axis; nothing if they lie in a plane. Points
/// may repeat. Quickhull [BDH96]: O(n log n) in practice, and some 100 bytes a face. The same for the same points in
/// the same order. Throws bad_argument if they span more.
[[nodiscard]] std::optional<ConvexHull> hull_of(std::span<const LatticeCoord> points);

constexpr double kNearlyConvex = 0.02;  ///< of a solid's volume: a hull with no more than that above it is as good
/// How far a step that simplifies a hull may move corners out of the box of what it begins with, in shares of the box's
/// longest side.
constexpr double kNearBox = 0.03;  ///< nobody sees it
constexpr double kFarOut = 1;      ///< and farther, where there is no other way

/// Six times its volume, rounded. Linear.
[[nodiscard]] double volume6_of(const ConvexHull& hull);

}  // namespace bp
