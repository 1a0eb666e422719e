#pragma once
#include "lib/enclosed/enclosed.h"
#include "lib/mesh/lattice_mesh.h"
#include "lib/simplify/simplify.h"

/// Makes room for quads. A tight proxy touches what it encloses, so the other diagonal of most pairs would cut into the
/// enclosed set, and few triangles can be joined to a quad that is safe under both diagonals (quads.h). Here vertices
/// move outwards a little where that makes both diagonals safe.
namespace bp {

/// `mesh`: closed, 2-manifold, embedded, with `enclosed` inside. The result has the same properties and as many
/// triangles; only edges are flipped and vertices moved. Pairs are chosen by their shape and by the volume that they
/// need. Each gets the diagonal that is nearer to the enclosed set; one end of it is lifted by the least volume that
/// makes the other diagonal safe. At last all vertices move back in as far as both diagonals of the pairs around them
/// allow. Every step is checked exactly; pairs are not checked against each other, as pair_triangles() does.
/// `edge_limit`, `limits`: as in ProxyEditor. Deterministic. Cost: a tightening with twice the exact tests.
[[nodiscard]] LatticeMesh make_room_for_quads(const LatticeMesh& mesh, const Enclosed& enclosed,
                                              const SimplifyParams& params);

}  // namespace bp
