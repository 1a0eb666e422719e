#include "lib/simplify/detail/bulk_order.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "lib/core/parallel.h"
#include "lib/simplify/cost_order.h"

namespace bp {

namespace {

constexpr float kNever = std::numeric_limits<float>::infinity();
constexpr float kUnknown = -1;
constexpr std::uint64_t kLittle = 20;  // a sweep that removes less than one in so many faces is the last with its bound

float rounded_down(double cost) {
  return float(cost) * (1 - 0x1p-22f);
}

}  // namespace

BulkOrder::BulkOrder(Collapser& collapser)
    : collapser_(collapser),
      mesh_(collapser.mesh()),
      planner_(collapser.ground()),
      worth_(3 * mesh_.face_capacity(), kUnknown),
      merged_in_(mesh_.vertex_capacity(), 0) {
  for (FaceId f = 0; f < mesh_.face_capacity(); ++f) {
    if (mesh_.alive(f)) faces_.push_back(f);
  }
}

std::uint64_t BulkOrder::sweep(double bound, std::uint64_t enough) {
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
  collapser_.count_solved(planner_);
  return taken;
}

bool BulkOrder::try_edge(HalfEdgeId h, double bound) {
  if (double(worth_[h]) > bound) return wait(h);
  const VertexId u = mesh_.from(h), w = mesh_.to(h);
  if (merged_in_[u] == sweep_ || merged_in_[w] == sweep_ || mesh_.locked(u) || mesh_.locked(w)) return false;
  if (worth_[h] == kUnknown) {
    worth_[h] = rounded_down(planner_.lower_bound(h));
    if (double(worth_[h]) > bound) return wait(h);
  }
  planner_.plan(h, bound, plan_);
  if (plan_.outcome == CollapsePlan::Outcome::too_dear) {
    worth_[h] = rounded_down(plan_.cost);
    return wait(h);
  }
  if (plan_.outcome == CollapsePlan::Outcome::refused || !collapser_.take(plan_)) {
    worth_[h] = kNever;
    return false;
  }
  merged_in_[u] = sweep_;
  if (mesh_.vertex_alive(u)) reconsider_around(u);
  return true;
}

/// Notes that the edge must wait for a larger bound.
bool BulkOrder::wait(HalfEdgeId h) {
  some_wait_ |= worth_[h] != kNever;
  return false;
}

/// Reconsiders the edges of u, whose costs have changed, and the refused edges in its two-ring.
void BulkOrder::reconsider_around(VertexId u) {
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

void collapse_bulk(std::span<BulkOrder* const> parts, BulkRange range, std::uint64_t enough) {
  const auto faces = [&] {
    return std::accumulate(parts.begin(), parts.end(), std::uint64_t(0),
                           [](std::uint64_t n, const BulkOrder* part) { return n + part->face_count(); });
  };
  for (double bound = range.first; faces() > enough && bound <= range.last;) {
    const std::uint64_t excess = faces() - enough;
    const std::vector<std::uint64_t> shares = shares_by_faces(excess, parts);
    std::vector<std::uint64_t> taken(parts.size(), 0);
    parallel_for(std::int64_t(parts.size()), [&](std::int64_t k) {
      BulkOrder& part = *parts[std::size_t(k)];
      taken[std::size_t(k)] = part.sweep(bound, part.face_count() - std::min(part.face_count(), excess));
    });
    const std::uint64_t all = std::accumulate(taken.begin(), taken.end(), std::uint64_t(0));
    if (all == 0 && std::none_of(parts.begin(), parts.end(), [](const BulkOrder* part) { return part->some_wait(); }))
      return;
    bool some_have_much = false;  // a part still has much to take within this bound, when little is left to take in all
    for (std::size_t i = 0; i < parts.size(); ++i) some_have_much |= taken[i] > 0 && 2 * taken[i] >= shares[i];
    if (all * kLittle < faces() && !some_have_much) bound *= 4;
  }
}

void collapse_bulk(Collapser& collapser, BulkRange range, std::uint64_t enough) {
  BulkOrder order(collapser);
  collapse_bulk(std::array{&order}, range, enough);
}

}  // namespace bp
