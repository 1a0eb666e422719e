#pragma once
#include "lib/meshing/piece.h"
#include "lib/meshing/simplify.h"

/// A dense surface, simplified by cells: in each brick flat regions are merged and edges collapsed; then the pieces of
/// eight cells weld into one that is simplified inside the larger cell, and so on. All work is done on pieces that fit
/// a cache, and cells run in parallel with a result that knows neither threads nor order (docs/decisions/0004).
namespace bp {

/// The whole surface with its quadrics, or without where nothing but flat regions was merged. Collapses stop well above
/// `enough` faces, at bounds on their cost that are the same in all cells: the rest is for the strict order.
/// `counts`: faces_flat, collapses, solved. `dense`: a dense_surface (surface.h).
[[nodiscard]] Piece simplified_surface(const LatticeMesh& dense, const SimplifyParams& params, std::uint64_t enough,
                                       SimplifyCounts& counts);

}  // namespace bp
