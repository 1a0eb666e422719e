#pragma once
#include "lib/simplify/simplify.h"
#include "lib/surface/piece.h"
#include "lib/surface/surface.h"

/// A dense surface, simplified by cells: in each brick flat regions are merged and edges collapsed; then the pieces of
/// eight cells weld into one that is simplified inside the larger cell, and so on. All work is done on pieces that fit
/// a cache, and cells run in parallel with a result that knows neither threads nor order nor memory
/// (docs/decisions/0004).
namespace bp {

/// Where sweeps over the bulk of a surface end.
struct BulkEnd {
  std::uint64_t faces = 0;  ///< so many are enough
  double cost = 0;          ///< no collapse costs more, lattice units^4; 0: no sweep is made
};

/// The whole surface with its quadrics, or without where nothing but flat regions was merged. Collapses stop well above
/// end.faces, at bounds on their cost that are the same in all cells: the rest is for the strict order. Limits are kept
/// if they have parts. `counts`: faces_in, faces_flat, collapses, solved.
/// The dense surface is never in memory as a whole: pieces wait as params.memory says, and no more of them are in hand
/// than it allows. Throws out_of_resource if one cell, or the result, takes more than that.
[[nodiscard]] Piece simplified_surface(const SurfaceSource& surface, const SimplifyParams& params, const BulkEnd& end,
                                       SimplifyCounts& counts);

/// Throws out_of_resource if `memory` does not suffice to simplify `faces` triangles at once: all of it, or, while
/// other pieces wait, its work_bytes. The limit that is named suffices for `later` triangles at once, too.
void check_work(std::uint64_t faces, const PieceMemory& memory, bool others_wait = false, std::uint64_t later = 0);

}  // namespace bp
