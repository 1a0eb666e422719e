#include "lib/tighten/detail/spikes.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>
#include <vector>

#include "lib/core/vec3.h"
#include "lib/mesh/lattice_geometry.h"
#include "lib/mesh/shells.h"

namespace bp {

namespace {

// Largest share of the area that may be left: where it is flat or round, more is left.
constexpr double kMostLeft = 0.9;
constexpr std::size_t kMostFaces = 32;  // at the vertex of a spike
constexpr int kFallRounds = 4;

/// Returns the volume that the proxy with its skin loses by a cut along `h`, the edge of a face across from the spike.
/// The faces that vanish are replaced by a fan around the third neighbour.
double gain_of_cut(const HalfEdgeMesh& mesh, HalfEdgeId h) {
  const HalfEdgeId t = mesh.twin(h);
  // The other faces meet the third neighbour.
  const std::array<FaceId, 2> faces{HalfEdgeMesh::face(h), HalfEdgeMesh::face(t)};
  const LatticeCoord &a = mesh.position(mesh.from(h)), &b = mesh.position(mesh.to(h)),
                     &spike = mesh.position(mesh.opposite(h)), &beyond = mesh.position(mesh.opposite(t)),
                     &third = mesh.position(mesh.opposite(mesh.twin(HalfEdgeMesh::next(h))));
  const double before =
      area_of(spike, a, b) + area_of(spike, b, third) + area_of(spike, third, a) + area_of(b, a, beyond);
  const double after = area_of(third, a, beyond) + area_of(third, beyond, b);
  return kSkin * (before - after) - double(fan_gain6(mesh, faces, third)) / 6;
}

/// Cuts off a spike, by the best cut that is allowed.
bool cut(ProxyEditor& editor, VertexId v) {
  const HalfEdgeMesh& mesh = editor.mesh();
  std::array<std::pair<double, HalfEdgeId>, 3> rim{};
  std::size_t n = 0;
  mesh.for_each_outgoing(v, [&](HalfEdgeId h) {
    const HalfEdgeId across = HalfEdgeMesh::next(h);
    rim[n++] = {-gain_of_cut(mesh, across), across};
  });
  std::sort(rim.begin(), rim.end());
  return std::any_of(rim.begin(), rim.end(), [&](const auto& c) { return c.first < 0 && editor.cut(c.second); });
}

/// Moves vertices to the place of a neighbour. A fin has no volume, but its skin has, since a fin has two sides.
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

  /// Lists the falls that remove a share of the area, and lower the volume of the proxy with its skin; best first.
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

  /// Returns the area that the faces of v would have if v were at `p`.
  [[nodiscard]] double area(VertexId v, const LatticeCoord& p) const {
    double sum = 0;
    mesh_.for_each_outgoing(
        v, [&](HalfEdgeId h) { sum += area_of(p, mesh_.position(mesh_.to(h)), mesh_.position(mesh_.opposite(h))); });
    return sum;
  }

  ProxyEditor& editor_;
  const HalfEdgeMesh& mesh_;
  std::vector<FaceId> faces_;  // of the vertex that may fall
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
