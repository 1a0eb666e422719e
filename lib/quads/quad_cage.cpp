// [XLG09] also takes the boundary of voxels and smooths it. Here the boundary shrinks like a skin: each vertex moves to
// the mean of its neighbours along quads, and inwards, as far as the enclosed set allows; at last to where the solid is
// smallest.
#include "lib/quads/quad_cage.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "lib/mesh/lattice_geometry.h"
#include "lib/quads/detail/enclosed_by_pairs.h"
#include "lib/quads/quads.h"
#include "lib/tighten/fan_fit.h"
#include "lib/tighten/proxy_editor.h"

namespace bp {

namespace {

constexpr int kSweeps = 40;
constexpr int kHalvings = 4;
constexpr int kFits = 4, kAvoidRounds = 4;
constexpr double kReach = 0.5;     // times the mean spoke: the farthest step of fit()
constexpr double kInwards = 0.15;  // times the mean edge: the step inwards in each sweep

class Skin {
 public:
  Skin(const CellQuads& cage, HalfEdgeMesh& mesh, ProxyEditor& editor, const std::optional<MirrorPlane>& plane)
      : cage_(cage), mesh_(mesh), editor_(editor), plane_(plane), near_(cage.mesh.vertices.size()) {
    for (const Quad& q : polygon_faces(cage.mesh).quads) {
      for (std::size_t i = 0; i < 4; ++i) {
        near_[q[i]].insert(q[(i + 1) % 4]);
        near_[q[i]].insert(q[(i + 3) % 4]);
      }
    }
  }

  /// Evens the vertices out and moves them inwards.
  void relax() {
    for_each([&](VertexId v) {
      relax(v);
      push(v);
    });
  }

  /// Moves each vertex to where the solid is smallest.
  void fit() {
    for_each([&](VertexId v) { fit(v); });
  }

 private:
  template <class Step>
  void for_each(const Step& step) {
    for (VertexId v = 0; v < near_.size(); ++v) {
      if (!plane_ || mesh_.position(v)[plane_->axis] >= plane_->lattice()) step(v);
    }
    editor_.refresh();
  }

  [[nodiscard]] Vec3d to_mean(VertexId v, double& edge) const {
    Vec3d sum{};
    edge = 0;
    for (const VertexId u : near_[v]) {
      const Vec3d d = to_double(mesh_.position(u) - mesh_.position(v));
      sum = sum + d;
      edge += length(d) / double(near_[v].size());
    }
    return (1 / double(near_[v].size())) * sum;
  }

  [[nodiscard]] Vec3d normal(VertexId v) const {
    Vec3d n{};
    mesh_.for_each_outgoing(v, [&](HalfEdgeId h) {
      n = n + to_double(normal_of(mesh_.position(v), mesh_.position(mesh_.to(h)), mesh_.position(mesh_.opposite(h))));
    });
    const double size = length(n);
    return size > 0 ? (1 / size) * n : n;
  }

  void relax(VertexId v) {
    double edge = 0;
    const Vec3d d = to_mean(v, edge), n = normal(v);
    if (go(v, d)) return;
    go(v, d - dot(d, n) * n);
  }

  void push(VertexId v) {
    double edge = 0;
    (void)to_mean(v, edge);
    go(v, (-kInwards * edge) * normal(v));
  }

  /// Moves v to where the faces around it enclose the least volume.
  void fit(VertexId v) {
    const LatticeCoord p = mesh_.position(v);
    const Vec3d shift = to_double(p - editor_.contacts().origin());
    const double reach = kReach * gather(v, shift);
    if (!fit_.close()) return;
    for (int round = 0; round < kAvoidRounds; ++round) {
      const auto x = fit_.least_volume({}, reach);
      if (!x || !(fit_.volume(*x) < fit_.volume({})) || move(v, p + rounded(*x))) return;
      if (editor_.blocker() == nullptr) {
        go(v, 0.5 * *x);
        return;
      }
      if (!fit_.avoid(*x, *editor_.blocker(), shift)) return;
    }
  }

  /// Gathers the fan around v and its contact points, less `shift`; returns the mean length of the spokes.
  double gather(VertexId v, const Vec3d& shift) {
    fit_.clear();
    double edges = 0;
    std::uint32_t sector = 0;
    mesh_.for_each_outgoing(v, [&](HalfEdgeId h) {
      const Vec3d spoke = to_double(mesh_.position(mesh_.to(h)) - mesh_.position(v));
      fit_.add_rim(spoke);
      edges += length(spoke);
      for (const std::uint32_t i : editor_.contacts().of(HalfEdgeMesh::face(h)))
        fit_.add_point(editor_.contacts()[i] - shift, sector);
      ++sector;
    });
    return edges / sector;
  }

  /// Moves v by `by`, or by the largest of its halves, quarters ... that is allowed.
  bool go(VertexId v, Vec3d by) {
    for (int i = 0; i < kHalvings; ++i, by = 0.5 * by) {
      if (length(by) < 1) return false;
      if (move(v, mesh_.position(v) + rounded(by))) return true;
    }
    return false;
  }

  bool move(VertexId v, LatticeCoord to) {
    if (!plane_) return editor_.move(v, to);
    const VertexId mate = cage_.mate[v];
    const LatticeCoord before = mesh_.position(v);
    if (mate == v) {
      to[plane_->axis] = plane_->lattice();
      return to != before && editor_.move(v, to);
    }
    if (to[plane_->axis] <= plane_->lattice() || !editor_.move(v, to)) return false;
    if (editor_.move(mate, plane_->mirrored(to))) return true;
    (void)editor_.move(v, before);
    return false;
  }

  const CellQuads& cage_;
  HalfEdgeMesh& mesh_;
  ProxyEditor& editor_;
  const std::optional<MirrorPlane>& plane_;
  std::vector<std::set<VertexId>> near_;  // per vertex: its neighbours along edges of quads
  FanFit fit_;
};

/// Returns the mesh without erased faces. `number`: the new number of each face.
LatticeMesh left_of(const CellQuads& cage, const HalfEdgeMesh& mesh, std::vector<FaceId>& number) {
  LatticeMesh out;
  out.frame = cage.mesh.frame;
  for (VertexId v = 0; v < cage.mesh.vertices.size(); ++v) out.vertices.push_back(mesh.position(v));
  number.assign(cage.mesh.triangles.size(), kNoId);
  for (FaceId f = 0; f < number.size(); ++f) {
    if (!mesh.alive(f)) continue;
    number[f] = FaceId(out.triangles.size());
    out.triangles.push_back(cage.mesh.triangles[f]);
  }
  drop_unused_vertices(out.vertices, out.triangles);
  return out;
}

/// Returns the pairs of triangles that may stay joined, together with their mirror images. The second half of the pairs
/// mirrors the first.
std::vector<std::array<std::uint32_t, 2>> pairs_left(const CellQuads& cage, const LatticeMesh& mesh,
                                                     const std::vector<FaceId>& number, const Enclosed& enclosed) {
  std::vector<std::array<std::uint32_t, 2>> pairs;
  for (const auto& [f, g] : cage.mesh.quads) pairs.push_back({number[f], number[g]});
  const std::vector<std::array<std::uint32_t, 2>> safe = safe_pairs(mesh, pairs, QuadKeeps::enclosed, &enclosed);
  const auto is_safe = [&](std::size_t i) { return std::binary_search(safe.begin(), safe.end(), pairs[i]); };
  std::vector<std::array<std::uint32_t, 2>> left;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const std::size_t image = cage.mate.empty() ? i : (i + pairs.size() / 2) % pairs.size();
    if (is_safe(i) && is_safe(image)) left.push_back(pairs[i]);
  }
  return left;
}

}  // namespace

LatticeMesh shrunk_cage(const CellQuads& cage, const Enclosed& enclosed, const std::optional<MirrorPlane>& plane) {
  HalfEdgeMesh mesh(cage.mesh);
  EnclosedByPairs kept(mesh, enclosed);
  for (const auto& [f, g] : cage.mesh.quads) kept.join(f, g);
  ProxyEditor editor(mesh, kept, {});
  Skin skin(cage, mesh, editor, plane);
  for (int i = 0; i < kSweeps; ++i) skin.relax();
  for (int i = 0; i < kFits; ++i) skin.fit();
  editor.erase_inner_shells();
  std::vector<FaceId> number;
  LatticeMesh out = left_of(cage, mesh, number);
  out.quads = pairs_left(cage, out, number, enclosed);
  return out;
}

}  // namespace bp
