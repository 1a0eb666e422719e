#pragma once
#include "lib/simplify/simplify_params.h"
#include "lib/surface/piece.h"

namespace bp {

/// Returns whether a surface of `faces` faces is large enough for regions.
[[nodiscard]] bool has_regions(std::uint64_t faces, const SimplifyParams& params);

/// Takes collapses in strict order (collapse_order.h) on the regions of a closed surface (regions.h), at the same time,
/// down to params.faces or as far as possible. Shells that turn inside out are erased. `whole` may have quadrics or
/// not. The result depends neither on threads nor on memory.
void collapse_in_regions(Piece& whole, const SimplifyParams& params, SimplifyCounts& counts);

/// Returns whether a surface of `faces` faces is large enough for regions in its bulk, too.
[[nodiscard]] bool has_bulk_regions(std::uint64_t faces, const BulkEnd& end, const SimplifyParams& params);

/// Sweeps the bulk (bulk_order.h) on the regions of a closed surface, at the same time, down to end.faces or a few
/// less, or as far as possible. Otherwise as collapse_in_regions().
void collapse_bulk_in_regions(Piece& whole, const BulkEnd& end, const SimplifyParams& params, SimplifyCounts& counts);

}  // namespace bp
