// Source: [Hil57], coordinate ascent on the dual: each constraint in turn takes the force that it needs, given the
// forces of the others. The stiffness is a multiple of the identity at each vertex, so a force on a face shifts its
// corners at once, and no matrix is factorised. Conjugate gradients on penalties did not converge, since each step
// changes which points press.
#include "lib/tighten/joint_fit.h"

#include <algorithm>

#include "lib/core/parallel.h"
#include "lib/core/vec3.h"
#include "lib/mesh/lattice_geometry.h"
#include "lib/mesh/space_order.h"
#include "lib/simplify/waves.h"
#include "lib/tighten/fan_fit.h"

namespace bp {

namespace {

constexpr double kDeepest = 2;  // lattice units: a point that is so much above its face lies under another one
constexpr double kRim = 8;      // lattice units: a point so near to the rim of its face lies under the neighbours, too
constexpr double kLongest = 2;  // times the unhindered step: the largest shift that forces may cause
constexpr int kRounds = 8;      // over all rows; and after each of these, over the rows with a force
constexpr int kRoundsOn = 6;    // over all rows, if it begins with the forces of an earlier fit
constexpr double kLeastGive = 1e-30;  // so that its inverse is a float

FourFloats lanes_of(const Vec3d& v, double fourth) {
  return FourFloats{float(v[0]), float(v[1]), float(v[2]), float(fourth)};
}

}  // namespace

double JointFit::growth(VertexId v) const {
  return dot(gradient_[v], shift_[v]);
}

JointFit::JointFit(const HalfEdgeMesh& mesh, const ContactPoints& contacts, ContactForces& forces)
    : mesh_(mesh), contacts_(contacts), forces_(forces), whole_(has_waves(mesh, false)), at_(mesh) {}

void JointFit::solve(double reach) {
  set_free_shifts(reach);
  set_places();
  if (whole_ && !at_.built()) at_.build(living_);
  gather_rows();
  at_.for_each([this](std::size_t block) {
    for (const Row& row : blocks_[block].rows) {
      if (row.force > 0) push(row, row.force);
    }
  });
  const int rounds = forces_.empty() ? kRounds : kRoundsOn;
  for (int round = 0; round < rounds; ++round) at_.for_each([this](std::size_t block) { relax(blocks_[block]); });
  keep_forces();
  for (std::size_t i = 0; i < living_.size(); ++i) {
    const VertexId v = living_[i];
    const FourFloats& moved = moving_[i].shift;
    shift_[v] = {double(moved[0]), double(moved[1]), double(moved[2])};
    const double size = length(shift_[v]), most = kLongest * reach_[v];
    if (size > most) shift_[v] = (most / size) * shift_[v];
  }
}

/// Gives each living vertex a place along a curve through space, so that the vertices of a block are neighbours in
/// memory, too.
void JointFit::set_places() {
  place_.assign(shift_.size(), 0);
  living_.clear();
  for (VertexId v = 0; v < shift_.size(); ++v) {
    if (mesh_.vertex_alive(v)) living_.push_back(v);
  }
  if (whole_) {
    living_ = space_order(
        living_.size(), [&](std::size_t i) { return living_[i]; }, [&](VertexId v) { return mesh_.position(v); });
  }
  moving_.resize(living_.size());
  for (std::uint32_t i = 0; i < living_.size(); ++i) {
    const VertexId v = living_[i];
    place_[v] = i;
    const auto soft = float(softness_[v]);
    moving_[i] = {lanes_of(shift_[v], 0), FourFloats{soft, soft, soft, 0}};
  }
}

void JointFit::Block::clear() {
  rows.clear();
  keys.clear();
}

void JointFit::Block::append(const Block& other) {
  rows.insert(rows.end(), other.rows.begin(), other.rows.end());
  keys.insert(keys.end(), other.keys.begin(), other.keys.end());
}

void JointFit::gather_rows() {
  const auto faces = std::int64_t(mesh_.face_capacity());
  const std::int64_t at_once = whole_ ? kItemsAtOnce : faces;
  blocks_.resize(at_.count());
  parts_.resize(std::size_t((faces + at_once - 1) / at_once), std::vector<Block>(blocks_.size()));
  parallel_ranges(faces, at_once, [&](std::int64_t begin, std::int64_t end) {
    std::vector<Block>& to = parts_[std::size_t(begin / at_once)];
    for (Block& block : to) block.clear();
    for (auto f = FaceId(begin); f < FaceId(end); ++f) {
      if (mesh_.alive(f)) add_rows(f, to);
    }
  });
  parallel_for(std::int64_t(blocks_.size()), [&](std::int64_t i) {
    Block& block = blocks_[std::size_t(i)];
    block.clear();
    for (const std::vector<Block>& part : parts_) block.append(part[std::size_t(i)]);
  });
}

void JointFit::keep_forces() {
  std::vector<ContactForces::Force> forces;
  for (const Block& block : blocks_) {
    for (const std::uint32_t i : block.pressing) {
      const auto& [face, point] = block.keys[i];
      if (block.rows[i].force > 0) forces.push_back({face, point, block.rows[i].force});
    }
  }
  forces_.set(forces, mesh_.face_capacity());
}

void JointFit::relax(Block& block) {
  block.pressing.clear();
  for (std::uint32_t i = 0; i < block.rows.size(); ++i) {
    relax(block.rows[i]);
    if (block.rows[i].force > 0) block.pressing.push_back(i);
  }
  for (int i = 0; i < kRounds; ++i) {
    for (const std::uint32_t r : block.pressing) relax(block.rows[r]);
  }
}

/// Sets the shifts of vertices that nothing hinders: `reach` times the mean spoke, against the gradient of the volume.
void JointFit::set_free_shifts(double reach) {
  const std::size_t n = mesh_.vertex_capacity();
  shift_.assign(n, {});
  gradient_.assign(n, {});
  reach_.assign(n, 0);
  softness_.assign(n, 0);
  parallel_ranges(std::int64_t(n), kItemsAtOnce, [&](std::int64_t begin, std::int64_t end) {
    for (auto v = VertexId(begin); v < VertexId(end); ++v) {
      if (mesh_.vertex_alive(v) && !mesh_.locked(v)) set_free_shift(v, reach);
    }
  });
}

void JointFit::set_free_shift(VertexId v, double reach) {
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
  if (!(size > 0)) return;  // the volume has no direction to fall in
  reach_[v] = reach * spokes / count;
  softness_[v] = reach_[v] / size;
  shift_[v] = -softness_[v] * gradient_[v];
}

JointFit::Facet JointFit::facet(FaceId f) const {
  Facet facet{f, at_.of(f), {}, {}, {}, 0, false, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    const VertexId v = mesh_.from(3 * f + HalfEdgeId(k));
    facet.corners[k] = to_double(mesh_.position(v) - contacts_.origin());
    facet.places[k] = place_[v];
    facet.softness[k] = softness_[v];
    facet.reach = std::max(facet.reach, reach_[v]);
    facet.held = facet.held || mesh_.locked(v);
  }
  const auto& [a, b, c] = facet.corners;
  facet.area = length(cross(b - a, c - a));
  return facet;
}

void JointFit::add_rows(FaceId f, std::vector<Block>& to) const {
  const Facet here = facet(f);
  for (const std::uint32_t i : contacts_.of(f)) {
    add_row(here, i, to);
    add_rows_beside(here, i, to);
  }
}

/// Adds rows for the neighbours of a face if the point lies near a corner or an edge: it lies under the neighbours,
/// too, so that a convex edge is held from both sides.
void JointFit::add_rows_beside(const Facet& facet, std::uint32_t point, std::vector<Block>& to) const {
  const Vec3d& p = contacts_[point];
  const auto is_at = [](const Vec3d& off, double scale) { return dot(off, off) <= kRim * kRim * scale; };
  const HalfEdgeId first = 3 * facet.id;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!is_at(p - facet.corners[k], 1)) continue;
    const VertexId v = mesh_.from(first + HalfEdgeId(k));
    if (mesh_.locked(v)) return;
    mesh_.for_each_outgoing(v, [&](HalfEdgeId h) {
      if (HalfEdgeMesh::face(h) != facet.id) add_row(this->facet(HalfEdgeMesh::face(h)), point, to);
    });
    return;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d& a = facet.corners[k];
    const Vec3d edge = facet.corners[(k + 1) % 3] - a;
    const HalfEdgeId beside = mesh_.twin(first + HalfEdgeId(k));
    if (beside != kNoId && is_at(cross(edge, p - a), dot(edge, edge)))
      add_row(this->facet(HalfEdgeMesh::face(beside)), point, to);
  }
}

void JointFit::add_row(const Facet& facet, std::uint32_t point, std::vector<Block>& to) const {
  const Vec3d& p = contacts_[point];
  if (facet.reach == 0 || !(facet.area > 0)) return;
  const Vec3d u = facet.corners[0] - p, v = facet.corners[1] - p, w = facet.corners[2] - p;
  const std::array<Vec3d, 3> gradient = {cross(v, w), cross(w, u), cross(u, v)};
  const double height = dot(u, gradient[0]) / facet.area;
  if (height < -kDeepest || height > kLongest * facet.reach) return;
  double least = kFitMargin - height;
  if (facet.held) least = std::min(least, 0.0);  // a locked corner would send the others far for a margin
  std::array<Vec3d, 3> g;
  double give = 0;  // rise of the height by a unit of force
  for (std::size_t k = 0; k < 3; ++k) {
    g[k] = (1 / facet.area) * gradient[k];
    give += facet.softness[k] * dot(g[k], g[k]);
  }
  if (!(give > kLeastGive)) return;
  to[facet.block].rows.push_back({{lanes_of(g[0], least), lanes_of(g[1], 1 / give), lanes_of(g[2], 0)},
                                  facet.places,
                                  forces_.of(facet.id, point)});
  to[facet.block].keys.push_back({facet.id, point});
}

void JointFit::relax(Row& row) {
  const std::array<FourFloats, 3>& g = row.gradient;
  const auto& [a, b, c] = row.places;
  const FourFloats rises = g[0] * moving_[a].shift + g[1] * moving_[b].shift + g[2] * moving_[c].shift;
  const float rise = rises[0] + rises[1] + rises[2];
  const float force = std::max(0.0F, row.force + (row.least() - rise) * row.ease());
  const float change = force - row.force;
  if (change == 0) return;
  row.force = force;
  push(row, change);
}

void JointFit::push(const Row& row, float force) {
  for (std::size_t k = 0; k < 3; ++k) {
    Moving& corner = moving_[row.places[k]];
    corner.shift += force * corner.softness * row.gradient[k];
  }
}

}  // namespace bp
