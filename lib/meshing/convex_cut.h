#pragma once
#include <vector>

#include "lib/meshing/convex_hull.h"
#include "lib/meshing/solid_cell.h"

/// Cells of solids whose hulls are near to them: the steps of an approximate convex decomposition.
namespace bp {

/// Cuts the solids by planes of the axes until there are `count` cells, or until each is nearly convex: its hull has no
/// more than `tolerance6` (six times a volume), or a fiftieth, above what the solid has in it. What is cut next is the
/// cell with most between the two, and where, so that the hulls of its halves have the least volume. Parallel; the
/// result does not depend on the number of threads.
[[nodiscard]] std::vector<SolidCell> cut_to_convex(std::vector<SolidCell> solids, std::size_t count, double tolerance6);

/// A hull, and what it is around.
struct Wrapped {
  ConvexHull hull;
  double solid6 = 0;  ///< six times the volume of the solid in its cells
};

/// Joins hulls, the pair first whose common hull adds the least volume, until there are `count`; and on, while one is
/// nearly as good as two: it adds no more than a twentieth of the two's volume, so bridges no gap, and has no more than
/// twice what cut_to_convex() allows a cell above the solid in it.
[[nodiscard]] std::vector<ConvexHull> merge_hulls(std::vector<Wrapped> hulls, std::size_t count, double tolerance6);

}  // namespace bp
