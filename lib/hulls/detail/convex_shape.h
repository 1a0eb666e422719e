#pragma once
#include "lib/hulls/convex_hull.h"
#include "lib/mesh/box_group.h"

/// Slivers of convex hulls, which physics engines and modellers cannot handle.
namespace bp {

constexpr double kSliverAngle = 0.017453292519943295;  ///< radians: least angle of a face; 1 degree
constexpr double kSliverEdge = 1e-3;                   ///< of the diagonal of the hull's box

/// Returns how far the faces are below the bounds above, as a sum of shares; 0: they keep them. A plate or a needle
/// always has narrow faces, so the bounds are no more than 0.9 of its width over its diagonal. Quadratic.
[[nodiscard]] double slivers_of(const ConvexHull& hull);

/// Chooses the diagonals of facets of more than three corners so that the least angles are as large as possible. The
/// solid is the same. Exact.
void draw_diagonals(ConvexHull& hull);

/// Returns a hull around `hull` without slivers, and with no more corners. Edges next to slivers are replaced by points
/// beyond the planes around them, the cheapest first. A sliver stays if no step removes it, or only one that holds more
/// than twice as much. Cost: milliseconds a sliver.
[[nodiscard]] ConvexHull without_slivers(ConvexHull hull);
/// Within the room, as far as the hull was.
[[nodiscard]] ConvexHull without_slivers(ConvexHull hull, const LatticeBox& room);

/// Returns the box along the axes around a hull, with 8 corners. For fewer corners it is a tetrahedron around that, of
/// 4.5 times its volume. It is the last resort.
[[nodiscard]] ConvexHull simple_hull_around(const ConvexHull& hull, std::size_t corners);

}  // namespace bp
