#include "lib/tighten/detail/spikes.h"

#include <array>

#include "lib/mesh/shells.h"

namespace bp {

namespace {

/// Six times what cutting by `h`, the edge of a face across from the spike, adds to the volume: the faces that go make
/// room for a fan around the third neighbour.
int128 cost6(const HalfEdgeMesh& mesh, HalfEdgeId h) {
  const std::array<FaceId, 2> faces{HalfEdgeMesh::face(h), HalfEdgeMesh::face(mesh.twin(h))};  // the others meet it
  return fan_gain6(mesh, faces, mesh.position(mesh.opposite(mesh.twin(HalfEdgeMesh::next(h)))));
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
