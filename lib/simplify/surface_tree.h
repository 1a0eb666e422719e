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
constexpr std::uint64_t kBytesPerDenseFace = 64, kBytesPerKeptFace = 28;

/// Throws out_of_resource if `memory` does not suffice to make a dense surface of `faces` triangles in one mesh.
void check_dense(std::uint64_t faces, const PieceMemory& memory);

}  // namespace bp
