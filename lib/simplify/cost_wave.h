#pragma once
#include <limits>

#include "lib/simplify/cost_order.h"
#include "lib/simplify/waves.h"

namespace bp {

/// Chooses edges for a wave of collapses: among the cheapest few percent, edges that leave each other alone. Without
/// waves it chooses the cheapest edge.
class CostWave {
 public:
  explicit CostWave(const HalfEdgeMesh& mesh) : mesh_(mesh), claims_(mesh) {}

  /// Returns the members of the chosen wave. They have left the queue.
  [[nodiscard]] const std::vector<CostEntry>& members() const { return members_; }

  /// Chooses a wave: at least one edge if any valid entry costs `most` or less, and no more than lead to `enough`
  /// faces. is_valid(entry) tells whether an entry is up to date; others are dropped. Returns the cost of the cheapest
  /// entry that was not looked at, valid or not; infinity if there is none.
  template <class IsValid>
  double choose(CostQueue& queue, bool waves, double most, std::uint64_t enough, const IsValid& is_valid) {
    constexpr double kShare = 0.05;  // share of all edges that may be looked at
    const std::size_t room = waves ? (mesh_.face_count() - enough + 1) / 2 : 1;
    std::size_t looks = waves ? std::size_t(kShare * 1.5 * double(mesh_.face_count())) : 1;
    members_.clear();
    later_.clear();
    claims_.begin();
    while (looks > 0 && members_.size() < room && !queue.empty() && queue.top().cost <= most) {
      const CostEntry top = queue.top();
      queue.pop();
      if (!is_valid(top)) continue;
      --looks;
      const bool joins = !waves || claims_.stars_are_free(top.edge);
      if (joins && waves) claims_.claim();
      (joins ? members_ : later_).push_back(top);
    }
    const double next = queue.empty() ? std::numeric_limits<double>::infinity() : queue.top().cost;
    for (const CostEntry& entry : later_) queue.push(entry);
    return next;
  }

 private:
  const HalfEdgeMesh& mesh_;
  WaveClaims claims_;
  std::vector<CostEntry> members_, later_;
};

}  // namespace bp
