#include "lib/simplify/detail/collapse_order.h"

#include <algorithm>

namespace bp {

namespace {

constexpr double kWaveShare = 0.05;  // of all edges: so many of those that cost least are looked at for a wave
constexpr std::size_t kPlansPerThread = 2, kCostsPerThread = 128;

}  // namespace

StrictOrder::StrictOrder(Collapser& collapser)
    : collapser_(collapser),
      mesh_(collapser.mesh()),
      planners_([&collapser] { return std::make_unique<CollapsePlanner>(collapser.ground()); }),
      claims_(mesh_),
      serial_(3 * mesh_.face_capacity(), 0),
      refusal_(3 * mesh_.face_capacity(), Refusal::none) {
  for (HalfEdgeId h = 0; h < serial_.size(); ++h) {
    if (is_edge(h)) renew(h);
  }
  push_renewed();
}

void StrictOrder::add_costs(std::vector<double>& costs) const {
  for (const CostEntry& entry : queue_.entries()) costs.push_back(entry.cost);
}

bool StrictOrder::run(double most, std::uint64_t enough) {
  bool some_left = true;
  while (some_left && mesh_.face_count() > enough) {
    const double next = choose(most, enough);
    some_left = !members_.empty();
    plan_wave(next);
    take_wave();
    push_renewed();
  }
  planners_.visit([&](CollapsePlanner& planner) { collapser_.count_solved(planner); });
  return some_left;
}

void StrictOrder::count(SimplifyCounts& counts) const {
  counts.refused = {};
  for (HalfEdgeId h = 0; h < refusal_.size(); ++h) {
    if (is_edge(h)) ++counts.refused[refusal_[h]];
  }
}

/// The members of a wave, one or more if anything is left for `most`; what the cheapest of the others costs, or `most`.
double StrictOrder::choose(double most, std::uint64_t enough) {
  const bool waves = has_waves(mesh_, collapser_.params().limits != nullptr);
  const std::size_t room = waves ? (mesh_.face_count() - enough + 1) / 2 : 1;
  std::size_t looked_at = waves ? std::size_t(kWaveShare * 1.5 * double(mesh_.face_count())) : 1;
  members_.clear();
  later_.clear();
  claims_.begin();
  while (looked_at > 0 && members_.size() < room && !queue_.empty() && queue_.top().cost <= most) {
    const CostEntry top = queue_.top();
    queue_.pop();
    if (!is_edge(top.edge) || serial_[top.edge] != top.serial) continue;
    --looked_at;
    const bool joins = !waves || claims_.stars_are_free(top.edge);
    if (joins && waves) claims_.claim();
    (joins ? members_ : later_).push_back(top);
  }
  const double next = queue_.empty() ? most : std::min(queue_.top().cost, most);
  for (const CostEntry& entry : later_) queue_.push(entry);
  return next;
}

void StrictOrder::plan_wave(double next) {
  if (plans_.size() < members_.size()) plans_.resize(members_.size());
  planners_.for_each(members_.size(), kPlansPerThread, [&](CollapsePlanner& planner, std::size_t i) {
    planner.plan(members_[i].edge, std::max(members_[i].cost, next), plans_[i]);
  });
}

/// Refusals first: what changes beside an edge gives it another chance.
void StrictOrder::take_wave() {
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (plans_[i].outcome == CollapsePlan::Outcome::refused) refusal_[members_[i].edge] = plans_[i].refusal;
  }
  boxes_.begin();
  for (std::size_t i = 0; i < members_.size(); ++i) take(members_[i], plans_[i]);
}

void StrictOrder::take(const CostEntry& entry, const CollapsePlan& plan) {
  if (plan.outcome == CollapsePlan::Outcome::too_dear) {  // not the best after all
    queue_.push({plan.cost, entry.edge, entry.serial});
    return;
  }
  if (plan.outcome == CollapsePlan::Outcome::refused) return;
  const VertexId u = mesh_.from(entry.edge);
  if (!boxes_.add(plan.boxes) || !collapser_.take(plan)) {
    queue_.push(entry);  // for the next wave
  } else if (mesh_.vertex_alive(u)) {
    renew_around(u);
  }
}

void StrictOrder::renew(HalfEdgeId h) {
  const HalfEdgeId e = mesh_.edge(h);
  if (mesh_.locked(mesh_.from(e)) || mesh_.locked(mesh_.to(e))) return;
  refusal_[e] = Refusal::none;
  renewed_.push_back({e, ++serial_[e]});
}

/// New entries for the edges at u, and another chance for refused edges one step further out.
void StrictOrder::renew_around(VertexId u) {
  mesh_.for_each_outgoing(u, [&](HalfEdgeId g) {
    renew(g);
    if (mesh_.locked(mesh_.to(g))) return;
    mesh_.for_each_outgoing(mesh_.to(g), [&](HalfEdgeId k) {
      if (refusal_[mesh_.edge(k)] != Refusal::none) renew(k);
    });
  });
}

void StrictOrder::push_renewed() {
  costs_.resize(renewed_.size());
  const std::size_t grain = mesh_.cell().holds(kEverywhere) ? kCostsPerThread : renewed_.size() + 1;
  planners_.for_each(renewed_.size(), grain, [&](CollapsePlanner& planner, std::size_t i) {
    const auto [edge, serial] = renewed_[i];
    if (is_edge(edge) && serial_[edge] == serial) costs_[i] = planner.lower_bound(edge);
  });
  for (std::size_t i = 0; i < renewed_.size(); ++i) {
    const auto [edge, serial] = renewed_[i];
    if (is_edge(edge) && serial_[edge] == serial) queue_.push({costs_[i], edge, serial});
  }
  renewed_.clear();
}

}  // namespace bp
