#pragma once
#include <algorithm>
#include <vector>

#include "lib/core/parallel.h"

namespace bp {

/// Sorts the items on all threads. `less` must order any two items, so that the result does not depend on the number of
/// threads. Memory: the items once more. O(n log n).
template <class Item, class Less>
void parallel_sort(std::vector<Item>& items, const Less& less) {
  constexpr std::size_t kChunk = std::size_t(1) << 13;
  const std::size_t n = items.size();
  const auto at = [n](auto& list, std::size_t i) { return list.begin() + std::ptrdiff_t(std::min(i, n)); };
  const auto runs_of = [n](std::size_t length) { return std::int64_t((n + length - 1) / length); };
  parallel_for(runs_of(kChunk), [&](std::int64_t run) {
    const std::size_t first = std::size_t(run) * kChunk;
    std::sort(at(items, first), at(items, first + kChunk), less);
  });
  std::vector<Item> merged(n > kChunk ? n : 0);
  for (std::size_t length = kChunk; length < n; length *= 2) {
    parallel_for(runs_of(2 * length), [&](std::int64_t pair) {
      const std::size_t first = std::size_t(pair) * 2 * length;
      std::merge(at(items, first), at(items, first + length), at(items, first + length), at(items, first + 2 * length),
                 at(merged, first), less);
    });
    items.swap(merged);
  }
}

}  // namespace bp
