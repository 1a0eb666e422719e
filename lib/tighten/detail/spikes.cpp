#include "lib/tighten/detail/spikes.h"

#include "lib/core/vec3.h"

namespace bp {

namespace {

/// Six times what cutting by `h`, the edge of a face across from the spike, adds to the volume: cones from the third
/// neighbour to the faces that go.
double cost6(const HalfEdgeMesh& mesh, HalfEdgeId h) {
  const HalfEdgeId t = mesh.twin(h);
  const LatticeCoord& apex = mesh.position(mesh.opposite(mesh.twin(HalfEdgeMesh::next(h))));
  const Vec3d a = to_double(mesh.position(mesh.from(h)) - apex), b = to_double(mesh.position(mesh.to(h)) - apex);
  const Vec3d spike = to_double(mesh.position(mesh.opposite(h)) - apex);
  const Vec3d beyond = to_double(mesh.position(mesh.opposite(t)) - apex);
  return dot(cross(a, b), beyond - spike);
}

bool cut(ProxyEditor& editor, VertexId v) {
  const HalfEdgeMesh& mesh = editor.mesh();
  std::array<HalfEdgeId, 3> rim{};
  std::size_t n = 0;
  mesh.for_each_outgoing(v, [&](HalfEdgeId h) { rim[n++] = HalfEdgeMesh::next(h); });
  for (const HalfEdgeId h : rim) {
    if (cost6(mesh, h) < 0 && editor.cut(h)) return true;
  }
  return false;
}

}  // namespace

std::uint64_t cut_spikes(ProxyEditor& editor) {
  const HalfEdgeMesh& mesh = editor.mesh();
  std::uint64_t n = 0;
  for (VertexId v = 0; v < mesh.vertex_capacity(); ++v) {
    if (mesh.vertex_alive(v) && !mesh.locked(v) && mesh.valence(v) == 3) n += cut(editor, v);
  }
  return n;
}

}  // namespace bp
