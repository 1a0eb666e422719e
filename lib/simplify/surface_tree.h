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

/// Returns what the first surface that `work(memory)` simplifies would take. It takes the memory of some bricks itself.
template <class Work>
[[nodiscard]] SurfaceWork counted_work(PieceMemory memory, const Work& work) {
  struct Counted {};
  SurfaceWork found;
  memory.waiting_bytes = 0;
  memory.count = [&found](const SurfaceWork& told) {
    found = told;
    throw Counted{};
  };
  try {
    work(memory);
  } catch (const Counted&) {  // as it was meant to end
  }
  return found;
}

// Bytes of each triangle of a dense surface in one mesh: two meshes of 12 and half a vertex of 24, and what joins them,
// while it is made; then one mesh, and a list of its triangles by bricks (MeshSurface).
constexpr std::uint64_t kBytesPerMeshedFace = 64, kBytesPerKeptFace = 28;

/// Throws out_of_resource if `memory` does not suffice to make a dense surface of `faces` triangles in one mesh.
void check_dense(std::uint64_t faces, const PieceMemory& memory);

}  // namespace bp
