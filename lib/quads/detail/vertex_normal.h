#pragma once
#include "lib/mesh/half_edge_mesh.h"
#include "lib/mesh/lattice_geometry.h"

namespace bp {

/// Returns the outer normal at v, of length 1, or 0 if it has none.
[[nodiscard]] inline Vec3d vertex_normal(const HalfEdgeMesh& mesh, VertexId v) {
  Vec3d n{};
  mesh.for_each_outgoing(v, [&](HalfEdgeId h) {
    n = n + to_double(normal_of(mesh.position(v), mesh.position(mesh.to(h)), mesh.position(mesh.opposite(h))));
  });
  return unit(n, {});
}

}  // namespace bp
