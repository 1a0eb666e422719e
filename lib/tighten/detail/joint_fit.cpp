// Source: [Hil57], coordinate ascent on the dual: each constraint in turn takes the force that it needs, given the
// forces of the others. The stiffness is a multiple of the identity at each vertex, so a force on a face shifts its
// corners at once and nothing has to be factorised. Conjugate gradients on penalties did not converge: which points
// press changes with each step.
#include "lib/tighten/detail/joint_fit.h"

#include <algorithm>

#include "lib/core/vec3.h"
#include "lib/mesh/lattice_geometry.h"

namespace bp {

namespace {

constexpr double kMargin = 0.6;  // lattice units over a point: rounding a corner moves it by up to 0.87
constexpr double kDeepest = 2;   // lattice units: a point that much above its face is under another one
constexpr double kRim = 8;       // lattice units: a point so near to the rim of its face is under those beside it, too
constexpr double kLongest = 2;   // times the unhindered step: how far forces may push
constexpr int kRounds = 8;       // over all rows
constexpr int kPressingRounds = 8;  // after each, over those with a force

}  // namespace

double JointFit::growth(VertexId v) const {
  return dot(gradient_[v], shift_[v]);
}

void JointFit::solve(double reach) {
  set_free_shifts(reach);
  rows_.clear();
  for (FaceId f = 0; f < mesh_.face_capacity(); ++f) {
    if (mesh_.alive(f)) add_rows(f);
  }
  for (int round = 0; round < kRounds; ++round) {
    pressing_.clear();
    for (std::uint32_t i = 0; i < rows_.size(); ++i) {
      relax(rows_[i]);
      if (rows_[i].force > 0) pressing_.push_back(i);
    }
    for (int i = 0; i < kPressingRounds; ++i) {
      for (const std::uint32_t r : pressing_) relax(rows_[r]);
    }
  }
  for (std::size_t v = 0; v < shift_.size(); ++v) {
    const double size = length(shift_[v]), most = kLongest * reach_[v];
    if (size > most) shift_[v] = (most / size) * shift_[v];
  }
}

/// Where vertices go with nothing in their way: `reach` mean spokes against the gradient of the volume.
void JointFit::set_free_shifts(double reach) {
  const std::size_t n = mesh_.vertex_capacity();
  shift_.assign(n, {});
  gradient_.assign(n, {});
  reach_.assign(n, 0);
  softness_.assign(n, 0);
  for (VertexId v = 0; v < n; ++v) {
    if (!mesh_.vertex_alive(v) || mesh_.locked(v)) continue;
    const LatticeCoord& p = mesh_.position(v);
    double spokes = 0;
    int count = 0;
    mesh_.for_each_outgoing(v, [&](HalfEdgeId h) {
      const Vec3d a = to_double(mesh_.position(mesh_.to(h)) - p), b = to_double(mesh_.position(mesh_.opposite(h)) - p);
      gradient_[v] = gradient_[v] + (1.0 / 6) * cross(a, b);
      spokes += length(a);
      ++count;
    });
    const double size = length(gradient_[v]);
    if (!(size > 0)) continue;  // no way in
    reach_[v] = reach * spokes / count;
    softness_[v] = reach_[v] / size;
    shift_[v] = -softness_[v] * gradient_[v];
  }
}

JointFit::Facet JointFit::facet(FaceId f) const {
  Facet facet{f, {}, {}, 0, false, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    const VertexId v = mesh_.from(3 * f + HalfEdgeId(k));
    facet.corners[k] = to_double(mesh_.position(v) - contacts_.origin());
    facet.softness[k] = softness_[v];
    facet.reach = std::max(facet.reach, reach_[v]);
    facet.held = facet.held || mesh_.locked(v);
  }
  const auto& [a, b, c] = facet.corners;
  facet.area = length(cross(b - a, c - a));
  return facet;
}

void JointFit::add_rows(FaceId f) {
  const Facet here = facet(f);
  for (const std::uint32_t i : contacts_.of(f)) {
    add_row(here, contacts_[i]);
    add_rows_beside(here, contacts_[i]);
  }
}

/// A point at a corner or an edge of its face lies under the others there, too: a convex edge is held from both sides.
void JointFit::add_rows_beside(const Facet& facet, const Vec3d& p) {
  const auto is_at = [](const Vec3d& off, double scale) { return dot(off, off) <= kRim * kRim * scale; };
  const HalfEdgeId first = 3 * facet.id;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!is_at(p - facet.corners[k], 1)) continue;
    const VertexId v = mesh_.from(first + HalfEdgeId(k));
    if (mesh_.locked(v)) return;
    mesh_.for_each_outgoing(v, [&](HalfEdgeId h) {
      if (HalfEdgeMesh::face(h) != facet.id) add_row(this->facet(HalfEdgeMesh::face(h)), p);
    });
    return;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d& a = facet.corners[k];
    const Vec3d edge = facet.corners[(k + 1) % 3] - a;
    const HalfEdgeId beside = mesh_.twin(first + HalfEdgeId(k));
    if (beside != kNoId && is_at(cross(edge, p - a), dot(edge, edge)))
      add_row(this->facet(HalfEdgeMesh::face(beside)), p);
  }
}

void JointFit::add_row(const Facet& facet, const Vec3d& p) {
  if (facet.reach == 0 || !(facet.area > 0)) return;
  const Vec3d u = facet.corners[0] - p, v = facet.corners[1] - p, w = facet.corners[2] - p;
  const std::array<Vec3d, 3> gradient = {cross(v, w), cross(w, u), cross(u, v)};
  const double height = dot(u, gradient[0]) / facet.area;
  if (height < -kDeepest || height > kLongest * facet.reach) return;
  double least = kMargin - height;
  if (facet.held) least = std::min(least, 0.0);  // near a corner that stays, others would have to go far for a margin
  Row row{facet.id, {}, float(least), 0, 0};
  double give = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d g = (1 / facet.area) * gradient[k];
    give += facet.softness[k] * dot(g, g);
    row.gradient[k] = {float(g[0]), float(g[1]), float(g[2])};
  }
  if (!(give > 0)) return;
  row.give = float(give);
  rows_.push_back(row);
}

void JointFit::relax(Row& row) {
  const HalfEdgeId h = 3 * row.face;
  const std::array<VertexId, 3> v = {mesh_.from(h), mesh_.from(h + 1), mesh_.from(h + 2)};
  double rise = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3f& g = row.gradient[k];
    const Vec3d& s = shift_[v[k]];
    rise += double(g[0]) * s[0] + double(g[1]) * s[1] + double(g[2]) * s[2];
  }
  const float force = std::max(0.0F, row.force + float((double(row.least) - rise) / double(row.give)));
  const double change = double(force) - double(row.force);
  if (change == 0) return;
  row.force = force;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3f& g = row.gradient[k];
    const double by = change * softness_[v[k]];
    shift_[v[k]] = shift_[v[k]] + Vec3d{by * double(g[0]), by * double(g[1]), by * double(g[2])};
  }
}

}  // namespace bp
