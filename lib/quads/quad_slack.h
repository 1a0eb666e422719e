#pragma once
#include "lib/enclosed/enclosed.h"
#include "lib/mesh/lattice_mesh.h"
#include "lib/simplify/simplify.h"

/// Room for quads. A tight proxy rests on what it encloses, so of most edges the other diagonal would cut into that,
/// and few triangles can be joined so that either diagonal is safe (quads.h). Here vertices move outwards a little,
/// where that makes room for both.
namespace bp {

/// `mesh`: closed, 2-manifold, embedded, with `enclosed` inside; so is the result, which has as many triangles, but for
/// some edges flipped and vertices moved. Pairs are chosen for their shape and the room that they need; each gets the
/// diagonal that is nearer to what is enclosed, over which one of its ends is lifted, by the least volume; at last all
/// vertices go back in as far as both diagonals of the pairs around them allow. Every step is checked exactly, the
/// pairs among themselves are not: pair_triangles() does that. `edge_limit`, `limits`: as in ProxyEditor.
/// Deterministic. Cost: that of a tightening with twice the exact tests.
[[nodiscard]] LatticeMesh make_room_for_quads(const LatticeMesh& mesh, const Enclosed& enclosed,
                                              const SimplifyParams& params);

}  // namespace bp
