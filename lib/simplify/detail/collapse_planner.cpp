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

constexpr double kLeastTurn = 0.1;  // cosine between a face's normal before and after
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
  gather_star(h);
  if (!link_holds()) {
    refuse(Refusal::link);
    return std::nullopt;
  }
  ++solved;
  gather_constraints();
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
    if (acceptable(p, cost)) return Candidate{origin_ + p, cost, attempt + 1 < kFreePlaces ? attempt : kNoOther};
  }
  return std::nullopt;
}

/// Returns the best place that keeps all constraints.
std::optional<CollapsePlanner::Candidate> CollapsePlanner::place_growing(const Quadric& q, const Vec3d& prior) {
  for (const double margin : {0.0, 0.9}) {  // 0.9 > sqrt(3)/2: rounding cannot leave the half-spaces then
    for (PlaneConstraint& s : constraints_) s.d += margin;
    const auto x = constrained_minimum(q, prior, constraints_);
    if (!x) break;
    const auto p = round_inside(*x, q);
    if (!p) continue;
    const double cost = q.value(to_double(*p));
    if (!acceptable(*p, cost)) return std::nullopt;
    return Candidate{origin_ + *p, cost, kNoOther};
  }
  refuse(Refusal::constraints);
  return std::nullopt;
}

/// Tries places between the free minimum, which may cut into the solid, and the constrained minimum, which only grows
/// it. Returns the first one that keeps the enclosed set inside.
std::optional<CollapsePlanner::Candidate> CollapsePlanner::place_enclosing(const Quadric& q, const Vec3d& prior,
                                                                           int first_attempt) {
  const Vec3d free = minimum(q, prior);
  const Vec3d grown = constrained_minimum(q, prior, constraints_).value_or(pushed_out(free));
  blocker_.count = 0;
  for (int attempt = first_attempt; attempt < kPlaces; ++attempt) {
    Vec3d x;
    for (std::size_t i = 0; i < 3; ++i) x[i] = free[i] + double(attempt) / kPlaces * (grown[i] - free[i]);
    const LatticeCoord p = rounded(x);
    const double cost = q.value(to_double(p));
    if (acceptable(p, cost) && keeps_inside(p)) return Candidate{origin_ + p, cost, attempt};
  }
  return std::nullopt;
}

/// If the constraints contradict each other: moves the place along the mean normal until most of them hold.
Vec3d CollapsePlanner::pushed_out(const Vec3d& x) const {
  Vec3d mean{};
  for (const StarFace& f : star_) {
    const Vec3d n = to_double(f.normal);
    for (std::size_t i = 0; i < 3; ++i) mean[i] += n[i];
  }
  const double size = length(mean);
  if (size == 0) return x;
  for (double& m : mean) m /= size;
  double depth = 0;
  for (const PlaneConstraint& s : constraints_) {
    const double slope = dot(s.n, mean);
    if (slope > 0.2) depth = std::max(depth, (s.d - dot(s.n, x)) / slope);
  }
  return {x[0] + depth * mean[0], x[1] + depth * mean[1], x[2] + depth * mean[2]};
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
  while (candidate && !may_be_taken(candidate->position - origin_))
    candidate = candidate->attempt == kNoOther ? std::nullopt : solve(h, candidate->attempt + 1);
  plan.refusal = refusal_;
  if (candidate) fill(*candidate, plan);
}

bool CollapsePlanner::may_be_taken(const LatticeCoord& p) {
  gather_new_faces(p);
  if (!stays_near()) return refuse(Refusal::growth);
  if (!is_free(p)) return refuse(Refusal::guard);
  return within_limits(params_.limits, mesh_, replaced_, new_faces_) || refuse(Refusal::limits);
}

void CollapsePlanner::fill(const Candidate& candidate, CollapsePlan& plan) const {
  const LatticeCoord p = candidate.position;
  plan.outcome = CollapsePlan::Outcome::allowed;
  plan.cost = candidate.cost;
  plan.position = p;
  plan.quadric = summed(plan.edge).about(to_double(p - origin_));
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
  return is_near(origin_) && is_near(origin_ + star_.back().apex);
}

/// Asks the guard. Parts of the surface that end up between the old faces and the new ones are erased (as in shells.h),
/// so that the surface bounds a solid from outside at any time.
bool CollapsePlanner::is_free(const LatticeCoord& p) {
  swallowed_.clear();
  if (!ground_.only_grows) return guard_.star_is_free(new_faces_, replaced_) && !turns_over(p);
  normals_before_.clear();
  LatticeBox box{origin_, origin_};
  for (const StarFace& f : star_) {
    normals_before_.push_back(f.normal);
    box.add(origin_ + f.apex);
  }
  if (!guard_.grown_star_is_free(new_faces_, replaced_, {normals_before_, box})) return false;
  const LatticeBox& both = guard_.box_of_both();
  for (const FaceId f : guard_.near()) {
    const LatticeBox around = box_of(mesh_.corner(f, 0), mesh_.corner(f, 1), mesh_.corner(f, 2));
    if (both.holds(around) && swallows(f, p)) swallowed_.push_back(f);
  }
  return swallowed_.empty() || guard_.rest_is_free(new_faces_);
}

/// Returns whether a free collapse would turn its shell inside out, which is not allowed. Shells that bound nothing any
/// more are found at the end (shells.h).
bool CollapsePlanner::turns_over(const LatticeCoord& p) const {
  return params_.free && ground_.sense->turns(replaced_.front(), fan_gain6(mesh_, replaced_, origin_ + p));
}

/// Returns whether face f lies between the old star and the new one, as its centre does, which is on neither of them.
bool CollapsePlanner::swallows(FaceId f, const LatticeCoord& p) const {
  const LatticeCoord sum = mesh_.corner(f, 0) + mesh_.corner(f, 1) + mesh_.corner(f, 2);
  const LatticeCoord centre = sum - origin_ * 3;  // three times as far from the origin
  return std::any_of(star_.begin(), star_.end(), [&](const StarFace& s) {
    const LatticeCoord apex = s.apex * 3, a = s.pa * 3, b = s.pb * 3, top = p * 3;
    return side_along(s.normal, centre - apex) >= 0 && side_along(s.normal, top - apex) > 0 &&
           orient3d(apex, b, top, centre) >= 0 && orient3d(b, a, top, centre) >= 0 &&
           orient3d(a, apex, top, centre) >= 0;
  });
}

void CollapsePlanner::gather_star(HalfEdgeId h) {
  star_.clear();
  ring_.clear();
  const VertexId u = kept_ = mesh_.from(h), w = mesh_.to(h);
  origin_ = mesh_.position(u);
  // Each spoke's end is the second corner of the face before it: its position is read once.
  const auto gather_fan = [&](HalfEdgeId first, VertexId other, bool both) {
    const LatticeCoord apex = mesh_.position(mesh_.from(first)) - origin_;
    LatticeCoord a = mesh_.position(other) - origin_;  // the fan begins at the edge itself
    HalfEdgeId g = first;
    do {
      const VertexId to = mesh_.to(g), next = mesh_.opposite(g);
      const LatticeCoord b = mesh_.position(next) - origin_;
      const bool lost = to == other || next == other;
      if (to != u) ring_.push_back(to);
      if (both || !lost) {
        star_.push_back({HalfEdgeMesh::face(g), to, next, apex, a, b, {}, lost});
        star_.back().normal = normal_of(apex, a, b);
      }
      a = b;
      g = mesh_.rotate(g);
    } while (g != first);
  };
  gather_fan(h, w, true);
  ring_split_ = ring_.size();
  gather_fan(mesh_.twin(h), u, false);
}

/// As HalfEdgeMesh::can_collapse, from the rings gathered.
bool CollapsePlanner::link_holds() const {
  const auto split = ring_.begin() + std::ptrdiff_t(ring_split_);
  std::ptrdiff_t common = 0;
  for (auto v = split; v != ring_.end(); ++v) common += std::count(ring_.begin(), split, *v);
  return common == 2 && !(ring_split_ == 3 && ring_.size() == 5);  // neighbours: 3 and 2, less from(h)
}

/// Gathers the half-spaces outside the planes of the star. Faces of a flat region follow each other and give one
/// half-space.
void CollapsePlanner::gather_constraints() {
  constraints_.clear();
  for (const StarFace& f : star_) {
    const Vec3d n = to_double(f.normal);
    const double size = length(n);
    const Vec3d unit = {n[0] / size, n[1] / size, n[2] / size};
    const double d = dot(unit, to_double(f.apex));
    const bool known = !constraints_.empty() && dot(constraints_.back().n, unit) > 1 - 1e-12 &&
                       std::abs(constraints_.back().d - d) < 1e-6;
    if (!known) constraints_.push_back({unit, d});
  }
}

/// Returns the cheapest lattice point near x that is exactly on or outside all planes.
std::optional<LatticeCoord> CollapsePlanner::round_inside(const Vec3d& x, const Quadric& q) const {
  const LatticeCoord near = rounded(x);
  if (outside_all(near)) return near;
  LatticeCoord low = near;  // the floor, within what predicates take
  for (int i = 0; i < 3; ++i) low[i] -= double(low[i]) > x[std::size_t(i)] ? 1 : 0;
  std::optional<LatticeCoord> best;
  double best_cost = 0;
  for (int i = 0; i < 8; ++i) {
    const LatticeCoord p = low + LatticeCoord{i & 1, (i >> 1) & 1, i >> 2};
    const double cost = q.value(to_double(p));
    if ((!best || cost < best_cost) && outside_all(p)) {
      best = p;
      best_cost = cost;
    }
  }
  return best;
}

/// Returns whether p is on or outside the plane of every face of the star; exact.
bool CollapsePlanner::outside_all(const LatticeCoord& p) const {
  return std::all_of(star_.begin(), star_.end(),
                     [&](const StarFace& f) { return side_along(f.normal, p - f.apex) >= 0; });
}

bool CollapsePlanner::acceptable(const LatticeCoord& p, double cost) {
  if (!ground_.room.holds_inside(origin_ + p)) return refuse(Refusal::growth);
  if (!shape_is_fine(p)) return refuse(Refusal::shape);
  if (ground_.volume6 > 0 && !adds_little(p)) return refuse(Refusal::growth);
  if (params_.edge_limit && !edges_are_short(p)) return refuse(Refusal::length);
  if (too_far(cost)) return refuse(Refusal::error);
  return true;
}

/// Returns whether no face flips, vanishes or becomes a needle.
bool CollapsePlanner::shape_is_fine(const LatticeCoord& p) const {
  double after = 1;  // least |cross product|^2 / (sum of squared edges)^2
  for (const StarFace& f : star_) {
    if (f.lost) continue;
    const LatticeCoord a = f.pa - p, b = f.pb - p, e = f.pb - f.pa;
    const Vec3d n0 = to_double(f.normal), n1 = to_double(normal_of(p, f.pa, f.pb));
    const double along = dot(n0, n1), squared = dot(n1, n1);
    if (along <= 0 || along * along < kLeastTurn * kLeastTurn * dot(n0, n0) * squared) return false;
    const double edges = double(a.x * a.x + a.y * a.y + a.z * a.z) + double(b.x * b.x + b.y * b.y + b.z * b.z) +
                         double(e.x * e.x + e.y * e.y + e.z * e.z);
    after = std::min(after, squared / (edges * edges));
  }
  const double quality = std::sqrt(12 * after);
  if (quality >= QualityFloor::kCollapse) return true;
  double before = 1;
  for (const StarFace& f : star_) before = std::min(before, triangle_quality(f.apex, f.pa, f.pb));
  return quality >= before / 2;
}

bool CollapsePlanner::adds_little(const LatticeCoord& p) const {
  double gain6 = 0;
  for (const StarFace& f : star_) gain6 += dot(to_double(f.normal), to_double(p - f.apex));
  const std::uint64_t faces = mesh_.face_count() + params_.whole.faces_elsewhere;
  return gain6 * double(faces) <= params_.most_growth * ground_.volume6;
}

bool CollapsePlanner::edges_are_short(const LatticeCoord& p) const {
  return std::all_of(star_.begin(), star_.end(),
                     [&](const StarFace& f) { return f.lost || params_.edge_limit(origin_ + p, origin_ + f.pa); });
}

/// Returns whether the merged planes are farther than the allowed error, in the root mean square over their area.
bool CollapsePlanner::too_far(double cost) const {
  if (params_.error_vox <= 0) return false;
  const double error = params_.error_vox * kLatticePerVoxel;
  return cost > weight_ * error * error;
}

bool CollapsePlanner::keeps_inside(const LatticeCoord& p) {
  gather_new_faces(p);
  swept_.clear();
  for (const StarFace& f : star_) {
    if (side_along(f.normal, p - f.apex) < 0)
      swept_.push_back({origin_ + f.apex, origin_ + f.pa, origin_ + f.pb, origin_ + p});
  }
  return params_.enclosed->allows(new_faces_, swept_, &blocker_) || refuse(Refusal::enclosed);
}

/// Gathers the fan that replaces the star if the edge collapses to p.
void CollapsePlanner::gather_new_faces(const LatticeCoord& p) {
  new_faces_.clear();
  replaced_.clear();
  for (const StarFace& f : star_) {
    replaced_.push_back(f.face);
    if (!f.lost) new_faces_.push_back({{kept_, f.a, f.b}, {origin_ + p, origin_ + f.pa, origin_ + f.pb}});
  }
}

}  // namespace bp
