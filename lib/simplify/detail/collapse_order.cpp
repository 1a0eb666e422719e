#include "lib/simplify/detail/collapse_order.h"

#include <algorithm>
#include <limits>

namespace bp {

namespace {

constexpr float kNever = std::numeric_limits<float>::infinity();
constexpr float kUnknown = -1;

class Bulk {
 public:
  explicit Bulk(Collapser& collapser)
      : collapser_(collapser),
        mesh_(collapser.mesh()),
        worth_(3 * mesh_.face_capacity(), kUnknown),
        merged_in_(mesh_.vertex_capacity(), 0) {
    for (FaceId f = 0; f < mesh_.face_capacity(); ++f) {
      if (mesh_.alive(f)) faces_.push_back(f);
    }
  }

  /// Returns the number of collapses.
  std::uint64_t sweep(double bound, std::uint64_t enough) {
    ++sweep_;
    some_wait_ = false;
    std::uint64_t taken = 0;
    std::size_t kept = 0;
    for (const FaceId f : faces_) {
      for (HalfEdgeId h = 3 * f; h < 3 * f + 3 && mesh_.alive(f) && mesh_.face_count() > enough; ++h) {
        if (mesh_.edge(h) == h) taken += try_edge(h, bound);
      }
      if (mesh_.alive(f)) faces_[kept++] = f;
    }
    faces_.resize(kept);
    return taken;
  }

  /// Of the last sweep, if it took nothing: false if no larger bound lets a sweep take anything.
  [[nodiscard]] bool some_wait() const { return some_wait_; }

 private:
  bool try_edge(HalfEdgeId h, double bound) {
    if (double(worth_[h]) > bound) return wait(h);
    const VertexId u = mesh_.from(h), w = mesh_.to(h);
    if (merged_in_[u] == sweep_ || merged_in_[w] == sweep_ || mesh_.locked(u) || mesh_.locked(w)) return false;
    if (worth_[h] == kUnknown) {
      worth_[h] = rounded_down(collapser_.lower_bound(h));
      if (double(worth_[h]) > bound) return wait(h);
    }
    const std::optional<Candidate> candidate = collapser_.solve(h);
    if (candidate && candidate->cost > bound) {
      worth_[h] = rounded_down(candidate->cost);
      return wait(h);
    }
    if (!collapser_.take(h, candidate)) {
      worth_[h] = kNever;
      return false;
    }
    merged_in_[u] = sweep_;
    if (mesh_.vertex_alive(u)) reconsider_around(u);
    return true;
  }

  /// For a larger bound.
  bool wait(HalfEdgeId h) {
    some_wait_ |= worth_[h] != kNever;
    return false;
  }

  static float rounded_down(double cost) { return float(cost) * (1 - 0x1p-22f); }

  /// The edges of u cost something else now, and those refused in the two-ring get another chance.
  void reconsider_around(VertexId u) {
    mesh_.for_each_outgoing(u, [&](HalfEdgeId g) {
      worth_[mesh_.edge(g)] = kUnknown;
      const VertexId n = mesh_.to(g);
      if (mesh_.locked(n)) return;
      mesh_.for_each_outgoing(n, [&](HalfEdgeId k) {
        float& worth = worth_[mesh_.edge(k)];
        if (worth == kNever) worth = kUnknown;
      });
    });
  }

  Collapser& collapser_;
  HalfEdgeMesh& mesh_;
  std::vector<FaceId> faces_;             // those to sweep over
  std::vector<float> worth_;              // per edge: below this bound no try is worth it
  std::vector<std::uint32_t> merged_in_;  // per vertex: sweep
  std::uint32_t sweep_ = 0;
  bool some_wait_ = false;  // for a larger bound
};

}  // namespace

void collapse_bulk(Collapser& collapser, BulkRange range, std::uint64_t enough) {
  Bulk bulk(collapser);
  const HalfEdgeMesh& mesh = collapser.mesh();
  for (double bound = range.first; mesh.face_count() > enough && bound <= range.last;) {
    const std::uint64_t taken = bulk.sweep(bound, enough);
    if (taken == 0 && !bulk.some_wait()) return;
    if (taken * 20 < mesh.face_count()) bound *= 4;
  }
}

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
