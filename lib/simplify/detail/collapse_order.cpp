#include "lib/simplify/detail/collapse_order.h"

#include <algorithm>

namespace bp {

StrictOrder::StrictOrder(Collapser& collapser)
    : collapser_(collapser),
      mesh_(collapser.mesh()),
      serial_(3 * mesh_.face_capacity(), 0),
      refusal_(3 * mesh_.face_capacity(), Refusal::none) {
  for (HalfEdgeId h = 0; h < serial_.size(); ++h) {
    if (is_edge(h)) push(h);
  }
}

void StrictOrder::add_costs(std::vector<double>& costs) const {
  for (const CostEntry& entry : queue_.entries()) costs.push_back(entry.cost);
}

bool StrictOrder::run(double most, std::uint64_t enough) {
  while (mesh_.face_count() > enough) {
    if (queue_.empty() || queue_.top().cost > most) return false;
    const CostEntry top = queue_.top();
    queue_.pop();
    if (is_edge(top.edge) && serial_[top.edge] == top.serial) try_entry(top, most);
  }
  return true;
}

void StrictOrder::count(SimplifyCounts& counts) const {
  counts.refused = {};
  for (HalfEdgeId h = 0; h < refusal_.size(); ++h) {
    if (is_edge(h)) ++counts.refused[refusal_[h]];
  }
}

void StrictOrder::push(HalfEdgeId h) {
  const HalfEdgeId e = mesh_.edge(h);
  if (mesh_.locked(mesh_.from(e)) || mesh_.locked(mesh_.to(e))) return;
  refusal_[e] = Refusal::none;
  queue_.push({collapser_.lower_bound(e), e, ++serial_[e]});
}

void StrictOrder::try_entry(const CostEntry& top, double most) {
  const std::optional<Candidate> candidate = collapser_.solve(top.edge);
  const double next = queue_.empty() ? most : std::min(queue_.top().cost, most);
  if (candidate && candidate->cost > top.cost && candidate->cost > next) {
    queue_.push({candidate->cost, top.edge, top.serial});  // not the best after all
    return;
  }
  const VertexId u = mesh_.from(top.edge);
  if (collapser_.take(top.edge, candidate)) {
    if (mesh_.vertex_alive(u)) renew_around(u);
  } else {
    refusal_[top.edge] = collapser_.refusal();
  }
}

/// New entries for the edges at u, and another chance for refused edges one step further out.
void StrictOrder::renew_around(VertexId u) {
  mesh_.for_each_outgoing(u, [&](HalfEdgeId g) {
    push(g);
    if (mesh_.locked(mesh_.to(g))) return;
    mesh_.for_each_outgoing(mesh_.to(g), [&](HalfEdgeId k) {
      if (refusal_[mesh_.edge(k)] != Refusal::none) push(k);
    });
  });
}

}  // namespace bp
