#pragma once
#include "lib/hulls/convex_hull.h"

/// Convex hulls with fewer corners around those with more.
namespace bp {

/// A hull around `hull` (each of its corners lies within or on it) of at most `most` corners, 8 or more. Corners go
/// while that adds no more than `growth` of the volume in all, and further until `most` is kept. Edges are replaced by
/// points beyond the planes around them, as in progressive hulls [SGG00].
[[nodiscard]] ConvexHull with_fewer_corners(ConvexHull hull, std::size_t most, double growth);

/// Moves corners that an earlier hull has too, outwards by about a lattice unit: no two hulls then have a corner at the
/// same place, so that files whose equal vertices are merged still hold hulls apart. Hulls only grow; of thin ones a
/// corner may move by an edge.
void set_corners_apart(std::vector<ConvexHull>& hulls);

}  // namespace bp
