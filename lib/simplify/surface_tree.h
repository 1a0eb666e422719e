#pragma once
#include "lib/simplify/simplify_params.h"
#include "lib/surface/piece.h"
#include "lib/surface/surface.h"

/// Simplifies a dense surface by cells: in each brick flat regions are merged and edges collapsed; then the pieces of
/// eight cells are welded into one that is simplified inside the larger cell, and so on. All work is done on pieces
/// that fit a cache. Cells run in parallel; the result depends neither on threads nor on order nor on memory
/// (docs/decisions/0004).
namespace bp {

/// Returns the whole surface with its quadrics, or without if only flat regions were merged. Collapses stop well above
/// end.faces, at bounds on their cost that are the same in all cells: the rest is for the strict order. Limits are kept
/// if they have parts. `counts`: faces_in, faces_flat, collapses, solved. The dense surface is never in memory as a
/// whole: params.memory bounds the pieces that wait and those at work. Throws out_of_resource if one cell, or the
/// result, takes more than that.
[[nodiscard]] Piece simplified_surface(const SurfaceSource& surface, const SimplifyParams& params, const BulkEnd& end,
                                       SimplifyCounts& counts);

/// Throws out_of_resource if `memory` does not suffice to simplify `faces` triangles at once: all of it, or its
/// work_bytes while other pieces wait. The limit named in the message suffices for `later` triangles at once, too.
void check_work(std::uint64_t faces, const PieceMemory& memory, bool others_wait = false, std::uint64_t later = 0);

}  // namespace bp
