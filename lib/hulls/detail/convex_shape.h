#pragma once
#include "lib/hulls/convex_hull.h"
#include "lib/mesh/box_group.h"

/// Slivers of convex hulls: what physics engines and modellers stumble over.
namespace bp {

constexpr double kSliverAngle = 0.017453292519943295;  ///< radians: of a face, its least; 1 degree
constexpr double kSliverEdge = 1e-3;                   ///< of the diagonal of the hull's box

/// How far the faces are below the bounds above, as a sum of shares; 0: they keep them. A plate or a needle has narrow
/// faces whatever one does: bounds are no more than 0.9 of its width over its diagonal. Quadratic.
[[nodiscard]] double slivers_of(const ConvexHull& hull);

/// Chooses the diagonals of facets of more than three corners so that the least angles are as large as may be. The
/// solid is the same. Exact.
void draw_diagonals(ConvexHull& hull);

/// A hull around `hull` without slivers, and with no more corners: edges beside slivers are replaced by points beyond
/// the planes around them, the cheapest first. Some stay where nothing takes them, or only what holds more than twice
/// as much. Cost: milliseconds a sliver.
[[nodiscard]] ConvexHull without_slivers(ConvexHull hull);
[[nodiscard]] ConvexHull without_slivers(ConvexHull hull, const LatticeBox& room);  ///< within it, as far as it was

/// The box of the axes around a hull, with 8 corners; or, for fewer, a tetrahedron around that, of 4.5 times its
/// volume: for what has no better way.
[[nodiscard]] ConvexHull simple_hull_around(const ConvexHull& hull, std::size_t corners);

}  // namespace bp
