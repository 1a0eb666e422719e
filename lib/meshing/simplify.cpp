// Sources: [GH97] quadric error metrics; [SGG00] and [DLCW11] for the constraint that the merged vertex lies on or
// outside the plane of every face around the edge; [CB17] §3.4 for the limit on edge lengths. Where we differ from
// [CB17]: every collapse is also checked exactly against the whole proxy (guard.h), which turns the local constraint
// into a global guarantee; candidates are solved lazily, from a lower bound (the unconstrained minimum of the summed
// quadrics), instead of eagerly for the two-ring.
#include "lib/meshing/simplify.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>

#include "lib/core/error.h"
#include "lib/core/predicates.h"
#include "lib/meshing/constrained_minimum.h"
#include "lib/meshing/flatten.h"
#include "lib/meshing/guard.h"
#include "lib/meshing/half_edge_mesh.h"

namespace bp {

namespace {

constexpr double kQualityFloor = 0.05;    // of 1 for the equilateral triangle; or no worse than half of what was there
constexpr std::uint64_t kBulkFactor = 8;  // the strict order begins at this many times the wanted faces
constexpr double kFirstBound =
    0.01 * 64 * 64 * 64 * 64;  // a tenth of a voxel off, over one voxel face; lattice units^4
constexpr double kLastBound = 1e300;
constexpr double kLeastTurn = 0.1;  // cosine between a face's normal before and after

struct Entry {
  double cost;  // of the constrained minimum, or a lower bound of it
  HalfEdgeId edge;
  std::uint32_t serial;
  bool operator<(const Entry& o) const { return cost != o.cost ? cost > o.cost : edge > o.edge; }  // least first
};

/// A collapse that passed every test but the guard.
struct Candidate {
  LatticeCoord position;
  double cost = 0;  // of the summed quadrics at `position`
};

class Simplifier {
 public:
  Simplifier(HalfEdgeMesh& mesh, const SimplifyParams& params, SimplifyCounts& counts)
      : mesh_(mesh),
        params_(params),
        counts_(counts),
        tree_(mesh),
        guard_(mesh, tree_),
        quadric_(mesh.vertex_capacity()),
        serial_(3 * mesh.face_capacity(), 0),
        parked_(3 * mesh.face_capacity(), 0),
        bound_(3 * mesh.face_capacity(), -1) {
    for (FaceId f = 0; f < mesh.face_capacity(); ++f) {
      if (mesh.alive(f)) add_face_quadric(f);
    }
  }

  /// Bulk: sweeps over all edges, taking what costs less than a bound that grows when a sweep takes little; each vertex
  /// merges at most once a sweep, so regions shrink evenly. No queue, and about one quadratic program per collapse:
  /// several times as fast as the strict order, which only the last part needs.
  void run_bulk() {
    const std::uint64_t enough = kBulkFactor * params_.faces;
    std::vector<std::uint32_t> merged_in(mesh_.vertex_capacity(), 0);
    std::uint32_t sweep = 0;
    for (double bound = kFirstBound; mesh_.face_count() > enough && bound < kLastBound;) {
      ++sweep;
      std::uint64_t taken = 0;
      for (HalfEdgeId h = 0; h < 3 * mesh_.face_capacity() && mesh_.face_count() > enough; ++h) {
        if (!mesh_.alive(HalfEdgeMesh::face(h)) || mesh_.edge(h) != h || parked_[h]) continue;
        if (merged_in[mesh_.from(h)] == sweep || merged_in[mesh_.to(h)] == sweep || known_bound(h) > bound) continue;
        const std::optional<Candidate> candidate = solve(h);
        if (candidate && too_far(h, candidate->cost)) {
          far_ = true;
          parked_[h] = 1;
          continue;
        }
        if (candidate && candidate->cost > bound) continue;
        const VertexId u = mesh_.from(h);
        if (!candidate || !take(h, *candidate)) {
          parked_[h] = 1;
          continue;
        }
        unpark_around(u);
        merged_in[u] = sweep;
        ++taken;
      }
      if (taken * 20 < mesh_.face_count()) bound *= 4;
    }
  }

  /// The strict order: least cost first.
  StopReason run() {
    for (HalfEdgeId h = 0; h < 3 * mesh_.face_capacity(); ++h) {
      if (mesh_.alive(HalfEdgeMesh::face(h)) && mesh_.edge(h) == h) push(h);
    }
    while (params_.faces == 0 || mesh_.face_count() > params_.faces) {
      if (heap_.empty()) return reason_to_end();
      const Entry top = heap_.top();
      heap_.pop();
      if (!mesh_.alive(HalfEdgeMesh::face(top.edge)) || mesh_.edge(top.edge) != top.edge ||
          serial_[top.edge] != top.serial)
        continue;
      const std::optional<Candidate> candidate = solve(top.edge);
      if (!candidate) {
        parked_[top.edge] = 1;
        continue;
      }
      if (candidate->cost > top.cost && !heap_.empty() &&
          candidate->cost > heap_.top().cost) {  // not the best after all
        heap_.push({candidate->cost, top.edge, top.serial});
        continue;
      }
      if (too_far(top.edge, candidate->cost)) {  // others may still be near enough: their cost counts less area
        far_ = true;
        parked_[top.edge] = 1;
        continue;
      }
      const VertexId u = mesh_.from(top.edge);
      if (take(top.edge, *candidate)) {
        renew_around(u);
      } else {
        parked_[top.edge] = 1;
      }
    }
    return StopReason::faces;
  }

 private:
  [[nodiscard]] StopReason reason_to_end() const {
    return far_       ? StopReason::error
           : limited_ ? StopReason::limits
           : long_    ? StopReason::edge_length
                      : StopReason::nothing_left;
  }

  void add_face_quadric(FaceId f) {
    const Vec3d n = to_double(normal_of(mesh_.corner(f, 0), mesh_.corner(f, 1), mesh_.corner(f, 2)));
    const double length = std::sqrt(dot(n, n));
    for (std::uint32_t k = 0; k < 3; ++k) {  // about the corner itself, where the plane's offset is zero
      quadric_[mesh_.from(3 * f + k)].add_plane({n[0] / length, n[1] / length, n[2] / length}, 0, length / 2);
    }
  }

  /// Both quadrics, about the position of from(h).
  [[nodiscard]] Quadric summed(HalfEdgeId h) const {
    const VertexId u = mesh_.from(h), w = mesh_.to(h);
    Quadric q = quadric_[w].about(to_double(mesh_.position(u) - mesh_.position(w)));
    q.add(quadric_[u]);
    return q;
  }

  [[nodiscard]] Vec3d midpoint(HalfEdgeId h) const {  // relative to from(h)
    const Vec3d e = to_double(mesh_.position(mesh_.to(h)) - mesh_.position(mesh_.from(h)));
    return {e[0] / 2, e[1] / 2, e[2] / 2};
  }

  /// No constrained minimum costs less than the free one.
  [[nodiscard]] double lower_bound(HalfEdgeId h) const {
    const Quadric q = summed(h);
    return std::max(0.0, q.value(minimum(q, midpoint(h))));
  }

  /// The lower bound, computed once until the neighbourhood changes.
  [[nodiscard]] double known_bound(HalfEdgeId e) {
    if (bound_[e] < 0) bound_[e] = float(lower_bound(e)) * (1 - 0x1p-22f);  // rounded down
    return double(bound_[e]);
  }

  void push(HalfEdgeId h) {
    const HalfEdgeId e = mesh_.edge(h);
    parked_[e] = 0;
    heap_.push({lower_bound(e), e, ++serial_[e]});
  }

  /// The merged planes are further than the allowed error, in the root mean square over their area.
  [[nodiscard]] bool too_far(HalfEdgeId h, double cost) const {
    if (params_.error_vox <= 0) return false;
    const double weight = quadric_[mesh_.from(h)].weight + quadric_[mesh_.to(h)].weight;
    const double error = params_.error_vox * kLatticePerVoxel;
    return cost > weight * error * error;
  }

  /// Best position for the collapse of h that keeps all constraints; nothing if there is none.
  std::optional<Candidate> solve(HalfEdgeId h) {
    if (!mesh_.can_collapse(h)) {
      ++counts_.refused_link;
      return std::nullopt;
    }
    ++counts_.solved;
    gather_star(h);
    const Quadric q = summed(h);
    const Vec3d prior = midpoint(h);
    if (params_.free) return solve_free(h, q, minimum(q, prior));
    bool feasible = false;
    for (const double margin : {0.0, 0.9}) {  // 0.9 > sqrt(3)/2: rounding cannot leave the half-spaces then
      for (PlaneConstraint& s : constraints_) s.d += margin;
      const auto x = constrained_minimum(q, prior, constraints_);
      if (!x) break;
      const auto rounded = round_inside(*x, q);
      if (!rounded) continue;
      feasible = true;
      if (params_.enclosed != nullptr) {
        if (const auto tighter = solve_enclosed(h, q, minimum(q, prior), *x)) return tighter;
      }
      const LatticeCoord p = mesh_.position(mesh_.from(h)) + *rounded;
      if (!shape_is_fine(h, p)) break;
      return Candidate{p, q.value(to_double(*rounded))};
    }
    if (!feasible) ++counts_.refused_constraints;
    return std::nullopt;
  }

  std::optional<Candidate> solve_free(HalfEdgeId h, const Quadric& q, const Vec3d& x) {
    const LatticeCoord offset{std::llround(x[0]), std::llround(x[1]), std::llround(x[2])};
    const LatticeCoord p = mesh_.position(mesh_.from(h)) + offset;
    if (!shape_is_fine(h, p)) return std::nullopt;
    return Candidate{p, q.value(to_double(offset))};
  }

  /// Between the free minimum, which may cut into the solid, and the constrained one, which only grows it: the first
  /// point that keeps inside what must stay inside.
  std::optional<Candidate> solve_enclosed(HalfEdgeId h, const Quadric& q, const Vec3d& free, const Vec3d& grown) {
    for (const double share : {0.0, 0.25, 0.5, 0.75}) {
      Vec3d x;
      for (std::size_t i = 0; i < 3; ++i) x[i] = free[i] + share * (grown[i] - free[i]);
      const LatticeCoord offset{std::llround(x[0]), std::llround(x[1]), std::llround(x[2])};
      const LatticeCoord p = mesh_.position(mesh_.from(h)) + offset;
      if (shape_is_fine(h, p) && keeps_inside(h, p)) return Candidate{p, q.value(to_double(offset))};
    }
    return std::nullopt;
  }

  [[nodiscard]] bool keeps_inside(HalfEdgeId h, const LatticeCoord& p) {
    gather_new_faces(h, p);
    swept_.clear();
    for (const HalfEdgeId g : star_) {
      const Tetrahedron t = {mesh_.position(mesh_.from(g)), mesh_.position(mesh_.to(g)),
                             mesh_.position(mesh_.opposite(g)), p};
      if (orient3d(t[0], t[1], t[2], t[3]) < 0) swept_.push_back(t);
    }
    return params_.enclosed->allows(new_faces_, swept_);
  }

  /// Faces around the edge, and the half-spaces outside their planes, relative to from(h).
  void gather_star(HalfEdgeId h) {
    star_.clear();
    constraints_.clear();
    const VertexId u = mesh_.from(h), w = mesh_.to(h);
    mesh_.for_each_outgoing(u, [&](HalfEdgeId g) { star_.push_back(g); });
    mesh_.for_each_outgoing(w, [&](HalfEdgeId g) {
      if (mesh_.to(g) != u && mesh_.opposite(g) != u) star_.push_back(g);
    });
    const LatticeCoord origin = mesh_.position(u);
    for (const HalfEdgeId g : star_) {
      const LatticeCoord a = mesh_.position(mesh_.from(g));
      const Vec3d n = to_double(normal_of(a, mesh_.position(mesh_.to(g)), mesh_.position(mesh_.opposite(g))));
      const double length = std::sqrt(dot(n, n));
      const Vec3d unit = {n[0] / length, n[1] / length, n[2] / length};
      const double d = dot(unit, to_double(a - origin));
      const bool known = std::any_of(constraints_.begin(), constraints_.end(), [&](const PlaneConstraint& s) {
        return dot(s.n, unit) > 1 - 1e-12 && std::abs(s.d - d) < 1e-6;
      });
      if (!known) constraints_.push_back({unit, d});
    }
  }

  /// The lattice point near x, on or outside all planes exactly, that costs least.
  std::optional<LatticeCoord> round_inside(const Vec3d& x, const Quadric& q) const {
    const LatticeCoord near{std::llround(x[0]), std::llround(x[1]), std::llround(x[2])};
    if (outside_all(near)) return near;
    std::optional<LatticeCoord> best;
    double best_cost = 0;
    for (int i = 0; i < 8; ++i) {
      const LatticeCoord p{std::int64_t(std::floor(x[0])) + (i & 1), std::int64_t(std::floor(x[1])) + ((i >> 1) & 1),
                           std::int64_t(std::floor(x[2])) + (i >> 2)};
      const double cost = q.value(to_double(p));
      if ((!best || cost < best_cost) && outside_all(p)) {
        best = p;
        best_cost = cost;
      }
    }
    return best;
  }

  /// Exact: p (relative to the first face's apex) is on or outside the plane of every face of the star.
  [[nodiscard]] bool outside_all(const LatticeCoord& p) const {
    const LatticeCoord q = mesh_.position(mesh_.from(star_[0])) + p;
    return std::all_of(star_.begin(), star_.end(), [&](HalfEdgeId g) {
      return orient3d(mesh_.position(mesh_.from(g)), mesh_.position(mesh_.to(g)), mesh_.position(mesh_.opposite(g)),
                      q) >= 0;
    });
  }

  /// No face flips, vanishes, becomes a needle, or gets an edge beyond the limit.
  bool shape_is_fine(HalfEdgeId h, const LatticeCoord& p) {
    const VertexId w = mesh_.to(h);
    double before = 1, after = 1, longest = 0;
    for (const HalfEdgeId g : star_) {
      const LatticeCoord &apex = mesh_.position(mesh_.from(g)), &a = mesh_.position(mesh_.to(g)),
                         &b = mesh_.position(mesh_.opposite(g));
      before = std::min(before, triangle_quality(apex, a, b));
      if (mesh_.to(g) == w || mesh_.opposite(g) == w) continue;  // the edge's own two faces
      const Vec3d n0 = to_double(normal_of(apex, a, b)), n1 = to_double(normal_of(p, a, b));
      const double l1 = dot(n1, n1);
      if (l1 == 0 || dot(n0, n1) < kLeastTurn * std::sqrt(dot(n0, n0) * l1)) {
        ++counts_.refused_shape;
        return false;
      }
      after = std::min(after, triangle_quality(p, a, b));
      const Vec3d e = to_double(a - p);
      longest = std::max(longest, dot(e, e));
    }
    if (after < std::min(kQualityFloor, before / 2)) {
      ++counts_.refused_shape;
      return false;
    }
    if (params_.edge_limit) {
      const double limit = params_.edge_limit(p);
      if (longest > limit * limit) {
        ++counts_.refused_length;
        long_ = true;
        return false;
      }
    }
    return true;
  }

  /// The fan that replaces the star which solve() gathered, if the edge collapses to p.
  void gather_new_faces(HalfEdgeId h, const LatticeCoord& p) {
    const VertexId u = mesh_.from(h), w = mesh_.to(h);
    new_faces_.clear();
    replaced_.clear();
    for (const HalfEdgeId g : star_) {
      replaced_.push_back(HalfEdgeMesh::face(g));
      const VertexId a = mesh_.to(g), b = mesh_.opposite(g);
      if (a == w || b == w) continue;
      new_faces_.push_back({{u, a, b}, {p, mesh_.position(a), mesh_.position(b)}});
    }
  }

  bool take(HalfEdgeId h, const Candidate& candidate) {
    const VertexId u = mesh_.from(h);
    gather_new_faces(h, candidate.position);
    if (!guard_.star_is_free(new_faces_, replaced_)) {
      ++counts_.refused_guard;
      return false;
    }
    if (!within_limits(params_.limits, mesh_, replaced_, new_faces_)) {
      ++counts_.refused_limits;
      limited_ = true;
      return false;
    }
    const LatticeCoord pu = mesh_.position(u);
    Quadric q = summed(h).about(to_double(candidate.position - pu));
    mesh_.collapse(h, candidate.position);
    quadric_[u] = q;
    ++counts_.collapses;
    mesh_.for_each_outgoing(u, [&](HalfEdgeId g) { tree_.update(HalfEdgeMesh::face(g)); });
    tree_.maintain();
    return true;
  }

  void unpark_around(VertexId u) {
    mesh_.for_each_outgoing(u, [&](HalfEdgeId g) {
      bound_[mesh_.edge(g)] = -1;
      mesh_.for_each_outgoing(mesh_.to(g), [&](HalfEdgeId k) { parked_[mesh_.edge(k)] = 0; });
    });
  }

  /// New entries for the edges at u, and another chance for parked edges one step further out.
  void renew_around(VertexId u) {
    mesh_.for_each_outgoing(u, [&](HalfEdgeId g) {
      push(g);
      mesh_.for_each_outgoing(mesh_.to(g), [&](HalfEdgeId k) {
        if (parked_[mesh_.edge(k)]) push(k);
      });
    });
  }

  HalfEdgeMesh& mesh_;
  const SimplifyParams& params_;
  SimplifyCounts& counts_;
  FaceTree tree_;
  Guard guard_;
  std::vector<Quadric> quadric_;       // per vertex, about its position
  std::vector<std::uint32_t> serial_;  // per half-edge: the one valid entry of its edge
  std::vector<char> parked_;           // refused until its neighbourhood changes
  std::vector<float> bound_;           // per half-edge: lower bound of its edge's cost, negative if unknown
  bool far_ = false;                   // some collapse was refused for its error,
  bool limited_ = false;               // by the limits,
  bool long_ = false;                  // for an edge too long
  std::priority_queue<Entry> heap_;
  std::vector<HalfEdgeId> star_;  // of the edge solved last: outgoing half-edges of both ends
  std::vector<PlaneConstraint> constraints_;
  std::vector<NewFace> new_faces_;
  std::vector<FaceId> replaced_;
  std::vector<Tetrahedron> swept_;
};

}  // namespace

std::string to_string(StopReason reason) {
  switch (reason) {
    case StopReason::faces:
      return "faces";
    case StopReason::error:
      return "error";
    case StopReason::limits:
      return "limits";
    case StopReason::edge_length:
      return "edge-length";
    case StopReason::nothing_left:
      return "no collapse left that keeps the guarantee";
  }
  return "";
}

void SimplifyCounts::add(const SimplifyCounts& next) {
  faces_out = next.faces_out;
  collapses += next.collapses;
  solved += next.solved;
  refused_link += next.refused_link;
  refused_constraints += next.refused_constraints;
  refused_shape += next.refused_shape;
  refused_length += next.refused_length;
  refused_guard += next.refused_guard;
  refused_limits += next.refused_limits;
  stop = next.stop;
}

LatticeMesh simplify(const LatticeMesh& dense, const SimplifyParams& params, SimplifyCounts& counts) {
  counts = {};
  counts.faces_in = dense.triangles.size();
  if (dense.triangles.empty()) return dense;
  HalfEdgeMesh mesh(dense);
  if (params.dense && !params.edge_limit) merge_flat_regions(mesh);  // it minds no edge length
  counts.faces_flat = mesh.face_count();
  Simplifier simplifier(mesh, params, counts);
  if (params.faces > 0 && params.dense) simplifier.run_bulk();
  counts.stop = simplifier.run();
  counts.faces_out = mesh.face_count();
  LatticeMesh out = mesh.compact(dense.frame);
  out.provenance = dense.provenance;
  return out;
}

}  // namespace bp
