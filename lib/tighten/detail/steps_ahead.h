#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "lib/core/parallel.h"
#include "lib/mesh/box_group.h"

/// A loop whose steps change a mesh near where they are, run on several threads with the result of one.
namespace bp {

/// Steps are planned in windows, at the same time, on the mesh as it is before the window; then they are made in their
/// order. A plan holds unless a step before it in the window changed something that it has seen; then the step is made
/// anew. So the result is that of the plain loop, whatever the windows are.
class StepsAhead {
 public:
  /// `workers`: plans of a window, at most. With 1 the loop is plain.
  explicit StepsAhead(std::size_t workers) : workers_(workers) {}
  [[nodiscard]] std::size_t workers() const { return workers_; }

  /// Steps 0 to n - 1.
  ///   wants(i): bool; whether there is something to plan, as the mesh is now; cheap
  ///   plan(i, worker): const LatticeBox&, around all that the plan has read; at the same time for several workers
  ///   make(worker, box): bool, the step that the worker has planned; false: nothing was changed, else `box` is around
  ///   what was
  ///   redo(i, box): bool; the whole step, with its question whether there is anything to do
  template <class Wants, class Plan, class Make, class Redo>
  void run(std::size_t n, const Wants& wants, const Plan& plan, const Make& make, const Redo& redo) {
    LatticeBox box;
    for (std::size_t i = 0; workers_ == 1 && i < n; ++i) static_cast<void>(redo(i, box));
    for (std::size_t first = 0, last = 0; workers_ > 1 && first < n; first = last) {
      steps_.clear();
      for (; last < n && steps_.size() < workers_; ++last) {
        if (wants(last)) steps_.push_back(last);
      }
      seen_.resize(steps_.size());
      parallel_for(std::int64_t(steps_.size()),
                   [&](std::int64_t k) { seen_[std::size_t(k)] = plan(steps_[std::size_t(k)], std::size_t(k)); });
      changed_.clear();
      for (std::size_t i = first, k = 0; i < last; ++i) {
        const bool planned = k < steps_.size() && steps_[k] == i;
        const bool changed = planned && is_untouched(seen_[k]) ? make(k, box) : redo(i, box);
        if (changed) changed_.push_back(box);
        k += planned;
      }
    }
  }

 private:
  [[nodiscard]] bool is_untouched(const LatticeBox& box) const {
    return std::none_of(changed_.begin(), changed_.end(), [&](const LatticeBox& c) { return c.meets(box); });
  }
  std::size_t workers_;
  std::vector<std::size_t> steps_;  // planned, of the window
  std::vector<LatticeBox> seen_;    // by each of them
  std::vector<LatticeBox> changed_;
};

}  // namespace bp
