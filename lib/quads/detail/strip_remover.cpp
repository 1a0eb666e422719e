// Strips of quads are removed as [DSSC08] removes them; here each step must keep the enclosed set inside.
#include "lib/quads/detail/strip_remover.h"

#include <algorithm>
#include <set>

#include "lib/mesh/lattice_geometry.h"

namespace bp {

namespace {

constexpr std::array<double, 6> kOutwards{0,    0.1, 0.2,
                                          0.35, 0.5, 0.75};  // times the mean edge: places of merged vertices
constexpr std::array<double, 3> kAlong{0.5, 0, 1};

std::vector<Quad> quads_of_pairs(const LatticeMesh& mesh) {
  std::vector<Quad> quads;
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 2) {
    quads.push_back(quad_of(mesh.triangles[i], mesh.triangles[i + 1]));
  }
  return quads;
}

std::size_t quads_around(const HalfEdgeMesh& mesh, VertexId v) {
  std::set<std::uint32_t> quads;
  mesh.for_each_outgoing(v, [&](HalfEdgeId h) { quads.insert(HalfEdgeMesh::face(h) / 2); });
  return quads.size();
}

/// Returns the mean length of the edges at two vertices.
double mean_spoke(const HalfEdgeMesh& mesh, VertexId a, VertexId d) {
  double sum = 0;
  int n = 0;
  for (const VertexId v : {a, d}) {
    mesh.for_each_outgoing(
        v, [&](HalfEdgeId h) { sum += length(to_double(mesh.position(mesh.to(h)) - mesh.position(v))), ++n; });
  }
  return sum / n;
}

/// Returns the cage with the quads that are left. Quad q has the triangles 2 q and 2 q + 1 of the mesh.
CellQuads cage_of(const HalfEdgeMesh& mesh, const std::vector<char>& alive, const CellQuads& before) {
  CellQuads out;
  out.mesh.frame = before.mesh.frame;
  std::vector<VertexId> number(mesh.vertex_capacity(), kNoId);
  for (VertexId v = 0; v < number.size(); ++v) {
    if (!mesh.vertex_alive(v)) continue;
    number[v] = VertexId(out.mesh.vertices.size());
    out.mesh.vertices.push_back(mesh.position(v));
  }
  if (!before.mate.empty()) {
    for (VertexId v = 0; v < number.size(); ++v) {
      if (number[v] != kNoId) out.mate.push_back(number[before.mate[v]]);
    }
  }
  for (std::uint32_t q = 0; q < alive.size(); ++q) {
    if (!alive[q]) continue;
    const auto n = std::uint32_t(out.mesh.triangles.size());
    for (const std::uint32_t f : {2 * q, 2 * q + 1})
      out.mesh.triangles.push_back(
          {number[mesh.from(3 * f)], number[mesh.from(3 * f + 1)], number[mesh.from(3 * f + 2)]});
    out.mesh.quads.push_back({n, n + 1});
  }
  return out;
}

/// Returns whether the triangles of these quads, and no others, are gone, so that `left` quads are left. Where surfaces
/// touch, a merge may take triangles of a quad beside the strip.
bool took_only(const HalfEdgeMesh& mesh, const std::vector<std::uint32_t>& gone, std::size_t left) {
  return mesh.face_count() == 2 * left && std::none_of(gone.begin(), gone.end(), [&](std::uint32_t q) {
           return mesh.alive(2 * q) || mesh.alive(2 * q + 1);
         });
}

}  // namespace

StripRemover::StripRemover(const CellQuads& cage, const Enclosed& enclosed, const std::optional<MirrorPlane>& plane)
    : cage_(cage),
      plane_(plane),
      quads_(quads_of_pairs(cage.mesh)),
      alive_(quads_.size(), 1),
      left_(quads_.size()),
      mesh_(cage.mesh),
      kept_(mesh_, enclosed),
      is_target_(mesh_.vertex_capacity(), 0) {
  kept_.give_contacts(false);
  kept_.allow_flips(true);
  kept_.set_least_quality(0);
  for (std::uint32_t q = 0; q < quads_.size(); ++q) kept_.join(2 * q, 2 * q + 1);
  editor_.emplace(mesh_, kept_, ShapeLimits{});
}

std::uint32_t StripRemover::image(std::uint32_t quad) const {
  const auto half = std::uint32_t(quads_.size() / 2);
  return quad < half ? quad + half : quad - half;
}

std::vector<std::uint32_t> StripRemover::quads_of(const Strip& strip) const {
  std::vector<std::uint32_t> all = strip.quads;
  if (!plane_) return all;
  for (const std::uint32_t q : strip.quads) all.push_back(image(q));
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

bool StripRemover::remove(const Strip& strip, const std::vector<std::uint32_t>& gone) {
  for (const auto& [from, to] : into_) is_target_[to] = 0;
  into_.clear();
  renamed_.clear();
  editor_->begin_undo();
  for (const std::uint32_t q : gone) kept_.part(2 * q, 2 * q + 1);
  bool done = merge_all(strip);
  for (const std::uint32_t q : gone) alive_[q] = 0;
  done = done && took_only(mesh_, gone, left_ - gone.size()) && rename(gone);
  if (done) {
    left_ -= gone.size();
    return true;
  }
  editor_->undo();
  for (std::size_t i = renamed_.size(); i-- > 0;) quads_[renamed_[i].first] = renamed_[i].second;
  for (const std::uint32_t q : gone) {
    alive_[q] = 1;
    kept_.join(2 * q, 2 * q + 1);
  }
  return false;
}

/// Merges the rungs of a strip and of its mirror image.
bool StripRemover::merge_all(const Strip& strip) {
  if (strip.rungs.size() == 1) {
    const VertexId corner = strip.rungs[0][0];
    if (!turn(strip.quads[0], corner) || (plane_ && !turn(image(strip.quads[0]), cage_.mate[corner]))) return false;
  }
  return std::all_of(strip.rungs.begin(), strip.rungs.end(), [&](const auto& rung) { return merge_rung(rung); });
}

/// Makes the diagonal from `corner` that of the quad's triangles.
bool StripRemover::turn(std::uint32_t quad, VertexId corner) {
  for (HalfEdgeId h = 6 * quad; h < 6 * quad + 3; ++h) {
    if (HalfEdgeMesh::face(mesh_.twin(h)) != 2 * quad + 1) continue;
    return mesh_.from(h) == corner || mesh_.to(h) == corner || editor_->flip(h);
  }
  return false;
}

/// Puts the merged vertices into the quads. Returns false if a vertex would have too few of them.
bool StripRemover::rename(const std::vector<std::uint32_t>& gone) {
  for (const std::array<VertexId, 2>& pair : into_) {
    const VertexId from = pair[0], to = pair[1];  // the lambda cannot capture a binding
    mesh_.for_each_outgoing(to, [&](HalfEdgeId h) {
      const std::uint32_t q = HalfEdgeMesh::face(h) / 2;
      const auto corner = std::find(quads_[q].begin(), quads_[q].end(), from);
      if (corner == quads_[q].end()) return;
      renamed_.push_back({q, quads_[q]});
      *corner = to;
    });
  }
  return std::all_of(gone.begin(), gone.end(), [&](std::uint32_t q) {
    return std::all_of(quads_[q].begin(), quads_[q].end(),
                       [&](VertexId v) { return !mesh_.vertex_alive(v) || quads_around(mesh_, v) >= 3; });
  });
}

bool StripRemover::merge_rung(const std::array<VertexId, 2>& rung) {
  auto [a, d] = rung;
  if (!mesh_.vertex_alive(a) || !mesh_.vertex_alive(d)) return plane_.has_value();  // its image was merged
  if (!plane_) return merge(a, d, false);
  if (cage_.mate[d] == d) std::swap(a, d);
  const VertexId ma = cage_.mate[a], md = cage_.mate[d];
  if (ma == d) return false;  // the strip runs along the plane
  const bool in_plane = ma == a;
  if (!merge(a, d, in_plane)) return false;
  if (md == d) return in_plane;  // the rung lies in the plane
  const LatticeCoord to = plane_->mirrored(mesh_.position(a));
  return merge_at(ma, md, to);
}

/// Merges d into a, at the innermost of some places that is allowed.
bool StripRemover::merge(VertexId a, VertexId d, bool in_plane) {
  const LatticeCoord &pa = mesh_.position(a), &pd = mesh_.position(d);
  const Vec3d half = 0.5 * to_double(pd - pa), out = vertex_normal(mesh_, a) + vertex_normal(mesh_, d);
  const double size = length(out), rung = mean_spoke(mesh_, a, d);
  for (const double share : kOutwards)
    for (const double along : kAlong) {
      LatticeCoord to = pa + rounded(2 * along * half + (size > 0 ? share * rung / size : 0) * out);
      if (in_plane) to[plane_->axis] = plane_->lattice();
      if (plane_ && !in_plane &&
          (to[plane_->axis] <= plane_->lattice()) != (mesh_.position(a)[plane_->axis] <= plane_->lattice()))
        return false;
      if (merge_at(a, d, to)) return true;
    }
  return false;
}

bool StripRemover::merge_at(VertexId a, VertexId d, const LatticeCoord& to) {
  // A strip may cross its image. A vertex that another one was merged into must stay, since into_ names it.
  if (!mesh_.vertex_alive(a) || !mesh_.vertex_alive(d) || is_target_[d]) return false;
  HalfEdgeId edge = kNoId;
  mesh_.for_each_outgoing(a, [&](HalfEdgeId h) {
    if (mesh_.to(h) == d) edge = h;
  });
  if (edge == kNoId || !kept_.allows_corner(d, to) || !editor_->collapse(edge, to)) return false;
  into_.push_back({d, a});
  is_target_[a] = 1;
  return true;
}

CellQuads StripRemover::result() const {
  return cage_of(mesh_, alive_, cage_);
}

}  // namespace bp
