#include "lib/tighten/detail/step_planner.h"

#include "lib/core/vec3.h"

namespace bp {

StepPlanner::StepPlanner(const ProxyEditor& editor, bool any_limits)
    : editor_(editor), mesh_(editor.mesh()), any_limits_(any_limits), check_(editor.new_check()) {}

void StepPlan::make(ProxyEditor& editor) const {
  if (!learned.empty()) editor.learn(vertex, learned);
  if (to) editor.make_move(vertex, *to);
  if (flips) editor.make_flip(edge);
}

void StepPlanner::begin(VertexId v, StepPlan& plan) {
  vertex_ = v;
  plan_ = &plan;
  plan.vertex = v;
  plan.edge = kNoId;
  plan.to.reset();
  plan.flips = false;
  plan.learned.clear();
}

/// Tries to move a vertex along x. If something is in the way, it becomes contact points for the next joint fit, and
/// the vertex goes a part of the way.
void StepPlanner::approach(VertexId v, const Vec3d& x, StepPlan& plan) {
  begin(v, plan);
  if (rounded(x) == LatticeCoord{} || try_move(x)) return;
  if (check_.blocker() != nullptr) {
    gather_rim();
    if (fit_.close()) static_cast<void>(learns(x));
  }
  if (!try_move(0.5 * x)) static_cast<void>(try_move(0.25 * x));
}

void StepPlanner::find_place(VertexId v, StepPlan& plan) {
  begin(v, plan);
  const double reach = kFanReach * gather_rim();
  if (!fit_.close()) return;
  gather_points();
  for (int round = 0;; ++round) {
    const std::optional<Vec3d> x = fit_.least_volume({}, reach);
    if (!x || !worth_trying(*x) || try_move(*x)) return;
    if (round < kFanRounds && check_.blocker() != nullptr && learns(*x)) continue;
    return shorten(*x, reach);
  }
}

void StepPlanner::go_back(VertexId v, const Vec3d& x, StepPlan& plan) {
  begin(v, plan);
  gather_rim();
  if (fit_.close() && worth_trying(x)) static_cast<void>(try_move(x));
}

void StepPlanner::flip(HalfEdgeId h, StepPlan& plan) {
  begin(mesh_.from(h), plan);
  plan.edge = h;
  plan.flips = editor_.is_convex(h) && check_.allows_flip(h);
  if (plan.flips) check_.put_boxes(plan.boxes);
}

void StepPlanner::count(ProxyEditor& editor) {
  editor.add(check_.counts);
  check_.counts = {};
}

/// Tries shorter steps along x. With limits, which may refuse a step aside, it also tries steps straight inwards.
void StepPlanner::shorten(const Vec3d& x, double reach) {
  for (double share = 0.5; share > 0.1 && worth_trying(share * x); share /= 2) {
    if (try_move(share * x)) return;
  }
  if (!any_limits_) return;
  const Vec3d inwards = -reach * fit_.outward();
  for (double share = 0.5; share > 0.01 && worth_trying(share * inwards); share /= 2) {
    if (try_move(share * inwards)) return;
  }
}

bool StepPlanner::worth_trying(const Vec3d& x) const {
  const LatticeCoord d = rounded(x);
  return d != LatticeCoord{} && fit_.volume(to_double(d)) < 0;
}

bool StepPlanner::try_move(const Vec3d& x) {
  const LatticeCoord to = mesh_.position(vertex_) + rounded(x);
  if (!check_.allows_move(vertex_, to)) return false;
  plan_->to = to;
  check_.put_boxes(plan_->boxes);
  return true;
}

/// Learns contact points from the obstacle of a move by x. Returns false if the fit knows no way around it.
bool StepPlanner::learns(const Vec3d& x) {
  if (!fit_.avoid(x, *check_.blocker(), place())) return false;
  plan_->learned.insert(plan_->learned.end(), fit_.obstacles().begin(), fit_.obstacles().end());
  return true;
}

Vec3d StepPlanner::place() const {
  return to_double(mesh_.position(vertex_) - editor_.contacts().origin());
}

/// Sets the rim of the fit from the vertex's star. Returns the mean spoke.
double StepPlanner::gather_rim() {
  const LatticeCoord p = mesh_.position(vertex_);
  fit_.clear();
  double spokes = 0;
  mesh_.for_each_outgoing(vertex_, [&](HalfEdgeId h) {
    const Vec3d a = to_double(mesh_.position(mesh_.to(h)) - p);
    fit_.add_rim(a);
    spokes += length(a);
  });
  return spokes / double(fit_.rim().size());
}

void StepPlanner::gather_points() {
  const ContactPoints& contacts = editor_.contacts();
  const Vec3d shift = place();
  std::uint32_t sector = 0;
  mesh_.for_each_outgoing(vertex_, [&](HalfEdgeId h) {
    for (const std::uint32_t i : contacts.of(HalfEdgeMesh::face(h))) fit_.add_point(contacts[i] - shift, sector);
    ++sector;
  });
}

}  // namespace bp
