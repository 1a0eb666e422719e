#pragma once
#include "lib/simplify/simplify.h"
#include "lib/simplify/surface_tree.h"

namespace bp {

/// A surface of so many faces is worth working on by regions.
[[nodiscard]] bool has_regions(std::uint64_t faces, const SimplifyParams& params);

/// The strict order (collapse_order.h) on the regions of a closed surface (regions.h), at the same time, down to
/// params.faces, or as far as it goes. Shells that turn are erased. `whole` has quadrics or not. The result depends
/// neither on threads nor on memory.
void collapse_in_regions(Piece& whole, const SimplifyParams& params, SimplifyCounts& counts);

/// A surface of so many faces has regions for its bulk, too.
[[nodiscard]] bool has_bulk_regions(std::uint64_t faces, const BulkEnd& end, const SimplifyParams& params);

/// The bulk (bulk_order.h) on the regions of a closed surface, at the same time, down to end.faces or a bit less, or as
/// far as it goes. Otherwise as above.
void collapse_bulk_in_regions(Piece& whole, const BulkEnd& end, const SimplifyParams& params, SimplifyCounts& counts);

}  // namespace bp
