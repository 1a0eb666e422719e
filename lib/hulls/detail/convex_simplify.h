#pragma once
#include "lib/hulls/convex_hull.h"

/// Convex hulls with fewer corners around hulls with more.
namespace bp {

/// Returns a hull around `hull` (each of its corners lies within or on it) of at most `most` corners, 8 or more.
/// Corners go while that adds no more than `growth` of the volume in all, and further until `most` is kept. Edges are
/// replaced by points beyond the planes around them, as in progressive hulls [SGG00].
[[nodiscard]] ConvexHull with_fewer_corners(ConvexHull hull, std::size_t most, double growth);

/// Moves corners that an earlier hull has, too, outwards by about a lattice unit. Then no two hulls have a corner at
/// the same place, so files whose equal vertices are merged still hold hulls apart. Hulls only grow. A corner of a thin
/// hull may move by an edge.
void set_corners_apart(std::vector<ConvexHull>& hulls);

}  // namespace bp
