// Sources: [GH97] quadric error metrics; [SGG00] and [DLCW11] for the constraint that the merged vertex lies on or
// outside the plane of every face around the edge; [CB17] §3.4 for the limit on edge lengths. Where we differ from
// [CB17]: every collapse is also checked exactly against the whole proxy (guard.h), which turns the local constraint
// into a global guarantee.
#include "lib/simplify/detail/collapse_planner.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lib/geometry/triangle_bvh.h"
#include "lib/mesh/step_limits.h"

namespace bp {

namespace {

constexpr int kPlaces = 2;      // number of places tried before the growing one: the free minimum, and halfway between
constexpr int kFreePlaces = 4;  // the same, if nothing must stay inside
constexpr int kNoOther = 4;     // number of the last attempt

}  // namespace

CollapsePlanner::CollapsePlanner(const CollapseGround& ground)
    : ground_(ground), mesh_(ground.mesh), params_(ground.params), guard_(ground.mesh, ground.tree) {}

/// Returns the sum of both ends' quadrics, relative to from(h).
Quadric CollapsePlanner::summed(HalfEdgeId h) const {
  const VertexId u = mesh_.from(h), w = mesh_.to(h);
  Quadric q = ground_.quadrics[w].about(to_double(mesh_.position(u) - mesh_.position(w)));
  q.add(ground_.quadrics[u]);
  return q;
}

Vec3d CollapsePlanner::midpoint(HalfEdgeId h) const {  // relative to from(h)
  const Vec3d e = to_double(mesh_.position(mesh_.to(h)) - mesh_.position(mesh_.from(h)));
  return {e[0] / 2, e[1] / 2, e[2] / 2};
}

double CollapsePlanner::lower_bound(HalfEdgeId h) const {
  const Quadric q = summed(h);
  return std::max(0.0, q.value(minimum(q, midpoint(h))));
}

std::optional<CollapsePlanner::Candidate> CollapsePlanner::solve(HalfEdgeId h, int first_attempt) {
  if (first_attempt == 0) refusal_ = Refusal::none;
  star_.gather(mesh_, h);
  if (!star_.link_holds()) {
    refuse(Refusal::link);
    return std::nullopt;
  }
  ++solved;
  star_.constrain(constraints_);
  const Quadric q = summed(h);
  const Vec3d prior = midpoint(h);
  weight_ = q.weight;
  if (params_.free) return place_free(q, prior, first_attempt);
  if (params_.enclosed != nullptr && first_attempt < kPlaces) {
    if (const auto candidate = place_enclosing(q, prior, first_attempt)) return candidate;
  }
  return place_growing(q, prior);
}

/// Tries these places in turn, and returns the first that is acceptable: the free minimum, one end of the edge, its
/// middle, its other end.
std::optional<CollapsePlanner::Candidate> CollapsePlanner::place_free(const Quadric& q, const Vec3d& prior,
                                                                      int first_attempt) {
  const std::array<Vec3d, kFreePlaces> places{minimum(q, prior), Vec3d{}, prior, 2.0 * prior};
  for (int attempt = first_attempt; attempt < kFreePlaces; ++attempt) {
    const LatticeCoord p = rounded(places[std::size_t(attempt)]);
    const double cost = q.value(to_double(p));
    if (acceptable(p, cost)) return Candidate{origin() + p, cost, attempt + 1 < kFreePlaces ? attempt : kNoOther};
  }
  return std::nullopt;
}

/// Returns the best place that keeps all constraints.
std::optional<CollapsePlanner::Candidate> CollapsePlanner::place_growing(const Quadric& q, const Vec3d& prior) {
  for (const double margin : {0.0, 0.9}) {  // 0.9 > sqrt(3)/2: rounding cannot leave the half-spaces then
    for (PlaneConstraint& s : constraints_) s.d += margin;
    const auto x = constrained_minimum(q, prior, constraints_);
    if (!x) break;
    const auto p = star_.round_inside(*x, q);
    if (!p) continue;
    const double cost = q.value(to_double(*p));
    if (!acceptable(*p, cost)) return std::nullopt;
    return Candidate{origin() + *p, cost, kNoOther};
  }
  refuse(Refusal::constraints);
  return std::nullopt;
}

/// Tries places between the free minimum, which may cut into the solid, and the constrained minimum, which only grows
/// it. Returns the first one that keeps the enclosed set inside.
std::optional<CollapsePlanner::Candidate> CollapsePlanner::place_enclosing(const Quadric& q, const Vec3d& prior,
                                                                           int first_attempt) {
  const Vec3d free = minimum(q, prior);
  const Vec3d grown = constrained_minimum(q, prior, constraints_).value_or(pushed_out(star_, free, constraints_));
  blocker_.count = 0;
  for (int attempt = first_attempt; attempt < kPlaces; ++attempt) {
    Vec3d x;
    for (std::size_t i = 0; i < 3; ++i) x[i] = free[i] + double(attempt) / kPlaces * (grown[i] - free[i]);
    const LatticeCoord p = rounded(x);
    const double cost = q.value(to_double(p));
    if (acceptable(p, cost) && keeps_inside(p)) return Candidate{origin() + p, cost, attempt};
  }
  return std::nullopt;
}

void CollapsePlanner::plan(HalfEdgeId h, double most, CollapsePlan& plan) {
  plan.edge = h;
  plan.outcome = CollapsePlan::Outcome::refused;
  std::optional<Candidate> candidate = solve(h, 0);
  if (candidate && candidate->cost > most) {
    plan.outcome = CollapsePlan::Outcome::too_dear;
    plan.cost = candidate->cost;
    return;
  }
  while (candidate && !may_be_taken(candidate->position - origin()))
    candidate = candidate->attempt == kNoOther ? std::nullopt : solve(h, candidate->attempt + 1);
  plan.refusal = refusal_;
  if (candidate) fill(*candidate, plan);
}

bool CollapsePlanner::may_be_taken(const LatticeCoord& p) {
  star_.fan_to(p, new_faces_, replaced_);
  if (!stays_near()) return refuse(Refusal::growth);
  if (!is_free(p)) return refuse(Refusal::guard);
  return within_limits(params_.limits, mesh_, replaced_, new_faces_) || refuse(Refusal::limits);
}

void CollapsePlanner::fill(const Candidate& candidate, CollapsePlan& plan) const {
  const LatticeCoord p = candidate.position;
  plan.outcome = CollapsePlan::Outcome::allowed;
  plan.cost = candidate.cost;
  plan.position = p;
  plan.quadric = summed(plan.edge).about(to_double(p - origin()));
  plan.face = replaced_.front();
  plan.gain6 = ground_.sense ? fan_gain6(mesh_, replaced_, p) : int128(0);
  plan.swallowed = swallowed_;
  plan.boxes.clear();
  if (ground_.only_grows) {
    plan.boxes.add(guard_.box_of_both());
  } else {
    for (const NewFace& f : new_faces_) plan.boxes.add(box_of(f.corners[0], f.corners[1], f.corners[2]));
  }
}

/// Tested last, since faces are long and the enclosed set has many voxels.
bool CollapsePlanner::stays_near() const {
  if (params_.enclosed == nullptr || params_.reach == 0) return true;
  return (!params_.free || leaves_near()) && params_.enclosed->is_near(new_faces_, params_.reach);
}

/// Returns true if both ends of the edge stay within reach of the new faces, as they must for a free collapse, which
/// encloses nothing.
bool CollapsePlanner::leaves_near() const {
  const auto is_near = [&](const LatticeCoord& end) {
    return std::any_of(new_faces_.begin(), new_faces_.end(), [&](const NewFace& f) {
      const auto at = [&](std::size_t k) { return to_double(f.corners[k] - end); };
      return distance_squared(Vec3d{}, TriangleD{at(0), at(1), at(2)}) <= params_.reach * params_.reach;
    });
  };
  return is_near(origin()) && is_near(origin() + star_.faces().back().apex);
}

/// Asks the guard. Parts of the surface that end up between the old faces and the new ones are erased (as in shells.h),
/// so that the surface bounds a solid from outside at any time.
bool CollapsePlanner::is_free(const LatticeCoord& p) {
  swallowed_.clear();
  if (!ground_.only_grows) return guard_.star_is_free(new_faces_, replaced_) && !turns_over(p);
  normals_before_.clear();
  for (const EdgeStar::Face& f : star_.faces()) normals_before_.push_back(f.normal);
  if (!guard_.grown_star_is_free(new_faces_, replaced_, {normals_before_, star_.box()})) return false;
  const LatticeBox& both = guard_.box_of_both();
  for (const FaceId f : guard_.near()) {
    const LatticeBox around = box_of(mesh_.corner(f, 0), mesh_.corner(f, 1), mesh_.corner(f, 2));
    if (!both.holds(around)) continue;
    // A face lies between the old star and the new one if its centre does, which is on neither of them.
    const LatticeCoord three = mesh_.corner(f, 0) + mesh_.corner(f, 1) + mesh_.corner(f, 2) - origin() * 3;
    if (star_.lies_between(three, p)) swallowed_.push_back(f);
  }
  return swallowed_.empty() || guard_.rest_is_free(new_faces_);
}

/// Returns whether a free collapse would turn its shell inside out, which is not allowed. Shells that bound nothing any
/// more are found at the end (shells.h).
bool CollapsePlanner::turns_over(const LatticeCoord& p) const {
  return params_.free && ground_.sense->turns(replaced_.front(), fan_gain6(mesh_, replaced_, origin() + p));
}

bool CollapsePlanner::acceptable(const LatticeCoord& p, double cost) {
  if (!ground_.room.holds_inside(origin() + p)) return refuse(Refusal::growth);
  if (!shape_is_fine(star_, p)) return refuse(Refusal::shape);
  if (ground_.volume6 > 0 && !adds_little(p)) return refuse(Refusal::growth);
  if (params_.edge_limit && !edges_are_short(p)) return refuse(Refusal::length);
  if (too_far(cost)) return refuse(Refusal::error);
  return true;
}

bool CollapsePlanner::adds_little(const LatticeCoord& p) const {
  const std::uint64_t faces = mesh_.face_count() + params_.whole.faces_elsewhere;
  return star_.growth6(p) * double(faces) <= params_.most_growth * ground_.volume6;
}

bool CollapsePlanner::edges_are_short(const LatticeCoord& p) const {
  return std::all_of(star_.faces().begin(), star_.faces().end(), [&](const EdgeStar::Face& f) {
    return f.lost || params_.edge_limit(origin() + p, origin() + f.pa);
  });
}

/// Returns whether the merged planes are farther than the allowed error, in the root mean square over their area.
bool CollapsePlanner::too_far(double cost) const {
  if (params_.error_vox <= 0) return false;
  const double error = params_.error_vox * kLatticePerVoxel;
  return cost > weight_ * error * error;
}

bool CollapsePlanner::keeps_inside(const LatticeCoord& p) {
  star_.fan_to(p, new_faces_, replaced_);
  star_.swept_to(p, swept_);
  return params_.enclosed->allows(new_faces_, swept_, &blocker_) || refuse(Refusal::enclosed);
}

}  // namespace bp
