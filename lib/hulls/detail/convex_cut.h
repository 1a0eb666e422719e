#pragma once
#include <vector>

#include "lib/hulls/detail/solid_cell.h"

/// Cells of solids whose hulls are near to them: the first half of an approximate convex decomposition.
namespace bp {

/// Cuts the solids by planes of the axes until there are `count` cells, or until each is nearly convex: its hull has no
/// more than `tolerance6` (six times a volume), or a fiftieth, above the solid in it. The cell with most between the
/// two is cut next, at the place where the hulls of its halves have the least volume. Parallel; the result does not
/// depend on the number of threads.
[[nodiscard]] std::vector<SolidCell> cut_to_convex(std::vector<SolidCell> solids, std::size_t count, double tolerance6);

}  // namespace bp
