#include "lib/quads/detail/skin.h"

#include <algorithm>

#include "lib/core/parallel.h"
#include "lib/mesh/lattice_geometry.h"
#include "lib/quads/quads.h"

namespace bp {

namespace {

constexpr int kHalvings = 4;
constexpr int kAvoidRounds = 4;
constexpr double kInwards = 0.15;  // times the mean edge: the step inwards in each sweep
constexpr double kJointReach = 1;  // times the mean spoke: the step of a vertex that nothing hinders
constexpr double kReach = 0.5;     // times the mean spoke: the farthest step of fit()

}  // namespace

Skin::Skin(const CellQuads& cage, HalfEdgeMesh& mesh, ProxyEditor& editor, const std::optional<MirrorPlane>& plane)
    : cage_(cage),
      mesh_(mesh),
      editor_(editor),
      plane_(plane),
      near_(cage.mesh.vertices.size()),
      joint_(mesh, editor.contacts(), editor.forces()) {
  for (const Quad& q : polygon_faces(cage.mesh).quads) {
    for (std::size_t i = 0; i < 4; ++i) {
      near_[q[i]].insert(q[(i + 1) % 4]);
      near_[q[i]].insert(q[(i + 3) % 4]);
    }
  }
}

template <class Step>
void Skin::for_each(const Step& step) {
  for (VertexId v = 0; v < near_.size(); ++v) {
    stop_if_asked();
    if (!plane_ || mesh_.position(v)[plane_->axis] >= plane_->lattice()) step(v);
  }
  editor_.refresh();
}

void Skin::relax() {
  for_each([&](VertexId v) {
    relax(v);
    push(v, kInwards);
  });
}

void Skin::swell(double share) {
  for_each([&](VertexId v) { push(v, -share); });
}

void Skin::fit() {
  for_each([&](VertexId v) { fit(v); });
}

/// Returns the shift of v by the joint fit; with a plane, the mean of that and its image's.
Vec3d Skin::joint_shift(VertexId v) const {
  Vec3d shift = joint_.shift(v);
  if (!plane_) return shift;
  Vec3d other = joint_.shift(cage_.mate[v]);
  other[std::size_t(plane_->axis)] *= -1;
  return 0.5 * (shift + other);
}

void Skin::fit_together() {
  joint_.solve(kJointReach);
  std::vector<std::pair<double, VertexId>> order;
  for (VertexId v = 0; v < near_.size(); ++v) {
    if (!plane_ || mesh_.position(v)[plane_->axis] >= plane_->lattice()) order.emplace_back(joint_.growth(v), v);
  }
  std::sort(order.begin(), order.end(),
            [](const auto& a, const auto& b) { return a.first != b.first ? a.first > b.first : a.second < b.second; });
  for (const auto& [growth, v] : order) {
    stop_if_asked();
    go(v, joint_shift(v));
  }
  editor_.refresh();
}

Vec3d Skin::to_mean(VertexId v, double& edge) const {
  Vec3d sum{};
  edge = 0;
  for (const VertexId u : near_[v]) {
    const Vec3d d = to_double(mesh_.position(u) - mesh_.position(v));
    sum = sum + d;
    edge += length(d) / double(near_[v].size());
  }
  return (1 / double(near_[v].size())) * sum;
}

void Skin::relax(VertexId v) {
  double edge = 0;
  const Vec3d d = to_mean(v, edge), n = vertex_normal(mesh_, v);
  if (go(v, d)) return;
  go(v, d - dot(d, n) * n);
}

void Skin::push(VertexId v, double inwards) {
  double edge = 0;
  (void)to_mean(v, edge);
  go(v, (-inwards * edge) * vertex_normal(mesh_, v));
}

/// Moves v to where the faces around it enclose the least volume.
void Skin::fit(VertexId v) {
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
double Skin::gather(VertexId v, const Vec3d& shift) {
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

bool Skin::go(VertexId v, Vec3d by) {
  for (int i = 0; i < kHalvings; ++i, by = 0.5 * by) {
    if (length(by) < 1) return false;
    if (move(v, mesh_.position(v) + rounded(by))) return true;
  }
  return false;
}

bool Skin::move(VertexId v, LatticeCoord to) {
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

}  // namespace bp
