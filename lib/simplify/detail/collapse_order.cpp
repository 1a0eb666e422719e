#include "lib/simplify/detail/collapse_order.h"

#include <algorithm>

namespace bp {

namespace {

constexpr std::size_t kPlansPerThread = 2, kCostsPerThread = 128;

}  // namespace

StrictOrder::StrictOrder(Collapser& collapser)
    : collapser_(collapser),
      mesh_(collapser.mesh()),
      planners_([&collapser] { return std::make_unique<CollapsePlanner>(collapser.ground()); }),
      wave_(mesh_),
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
    const double next =
        wave_.choose(queue_, has_waves(mesh_, collapser_.params().limits != nullptr), most, enough,
                     [&](const CostEntry& e) { return is_edge(e.edge) && serial_[e.edge] == e.serial; });
    some_left = !wave_.members().empty();
    plan_wave(std::min(next, most));
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

void StrictOrder::plan_wave(double next) {
  const std::vector<CostEntry>& members = wave_.members();
  if (plans_.size() < members.size()) plans_.resize(members.size());
  planners_.for_each(members.size(), kPlansPerThread, [&](CollapsePlanner& planner, std::size_t i) {
    planner.plan(members[i].edge, std::max(members[i].cost, next), plans_[i]);
  });
}

/// Handles the refused members first: changes beside an edge give it another chance.
void StrictOrder::take_wave() {
  const std::vector<CostEntry>& members = wave_.members();
  for (std::size_t i = 0; i < members.size(); ++i) {
    if (plans_[i].outcome == CollapsePlan::Outcome::refused) refusal_[members[i].edge] = plans_[i].refusal;
  }
  boxes_.begin();
  for (std::size_t i = 0; i < members.size(); ++i) take(members[i], plans_[i]);
}

void StrictOrder::take(const CostEntry& entry, const CollapsePlan& plan) {
  if (plan.outcome == CollapsePlan::Outcome::too_dear) {  // the edge turned out not to be the cheapest
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

/// Makes new entries for the edges at u, and gives refused edges one step further out another chance.
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
