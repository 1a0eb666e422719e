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

/// Returns the hull of points that span less than 2^29 lattice units along each axis; nothing if they lie in a plane.
/// Points may repeat. Quickhull [BDH96]: O(n log n) in practice, and some 100 bytes a face. The same points in the same
/// order give the same hull. Throws bad_argument if they span more.
[[nodiscard]] std::optional<ConvexHull> hull_of(std::span<const LatticeCoord> points);

/// A share of a solid's volume: a hull that has at most this much more is as good as the solid.
constexpr double kNearlyConvex = 0.02;
/// Shares of a box's longest side: a step that simplifies a hull may move corners so far out of the box that the hull
/// had at first.
constexpr double kNearBox = 0.03;  ///< the usual limit, which nobody sees
constexpr double kFarOut = 1;      ///< the limit where there is no other way

/// Returns six times its volume, rounded. Linear.
[[nodiscard]] double volume6_of(const ConvexHull& hull);

}  // namespace bp
