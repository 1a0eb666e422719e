#include "lib/tighten/detail/spikes.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <vector>

#include "lib/core/vec3.h"
#include "lib/mesh/shells.h"

namespace bp {

namespace {

constexpr double kSkin = 0.3 * kLatticePerVoxel;  // less than what voxels leave between a proxy and its scene
constexpr double kMostLeft = 0.9;                 // of the area: what is flat or round keeps more
constexpr std::size_t kMostFaces = 32;            // at a spike
constexpr int kFallRounds = 4;

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

/// Vertices that go to the place of a neighbour. A fin has no volume, but two sides: a skin around it has.
class Falls {
 public:
  explicit Falls(ProxyEditor& editor) : editor_(editor), mesh_(editor.mesh()) {}

  std::uint64_t run() {
    std::uint64_t all = 0, some = 1;
    for (int round = 0; round < kFallRounds && some > 0; ++round) {
      some = 0;
      for (VertexId v = 0; v < mesh_.vertex_capacity(); ++v) {
        if (mesh_.vertex_alive(v) && !mesh_.locked(v)) some += fall(v);
      }
      all += some;
    }
    return all;
  }

 private:
  struct Fall {
    double gain;
    HalfEdgeId edge;  // to the neighbour
  };

  bool fall(VertexId v) {
    faces_.clear();
    mesh_.for_each_outgoing(v, [&](HalfEdgeId h) { faces_.push_back(HalfEdgeMesh::face(h)); });
    if (faces_.size() > kMostFaces) return false;
    find_falls(v);
    return std::any_of(falls_.begin(), falls_.end(),
                       [&](const Fall& f) { return editor_.collapse(f.edge, mesh_.position(mesh_.to(f.edge))); });
  }

  /// Those that take some of the area away, and volume of the proxy in its skin; best first.
  void find_falls(VertexId v) {
    falls_.clear();
    const double skin = kSkin * area(v, mesh_.position(v));
    mesh_.for_each_outgoing(v, [&](HalfEdgeId h) {
      if (mesh_.locked(mesh_.to(h))) return;
      const LatticeCoord& to = mesh_.position(mesh_.to(h));
      const double after = kSkin * area(v, to);
      if (after > kMostLeft * skin) return;
      const double gain = skin - after - double(fan_gain6(mesh_, faces_, to)) / 6;
      if (gain > 0) falls_.push_back({gain, h});
    });
    std::sort(falls_.begin(), falls_.end(),
              [](const Fall& a, const Fall& b) { return std::tie(b.gain, a.edge) < std::tie(a.gain, b.edge); });
  }

  /// Of the faces of v, if it were at `p`.
  [[nodiscard]] double area(VertexId v, const LatticeCoord& p) const {
    double twice = 0;
    mesh_.for_each_outgoing(v, [&](HalfEdgeId h) {
      twice += length(to_double(normal_of(p, mesh_.position(mesh_.to(h)), mesh_.position(mesh_.opposite(h)))));
    });
    return twice / 2;
  }

  ProxyEditor& editor_;
  const HalfEdgeMesh& mesh_;
  std::vector<FaceId> faces_;  // of the vertex at hand
  std::vector<Fall> falls_;
};

}  // namespace

std::uint64_t drop_spikes(ProxyEditor& editor) {
  const HalfEdgeMesh& mesh = editor.mesh();
  std::uint64_t n = Falls(editor).run();
  for (VertexId v = 0; v < mesh.vertex_capacity(); ++v) {
    if (mesh.vertex_alive(v) && !mesh.locked(v) && mesh.valence(v) == 3) n += cut(editor, v);
  }
  return n;
}

}  // namespace bp
