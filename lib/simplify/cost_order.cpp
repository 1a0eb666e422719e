#include "lib/simplify/cost_order.h"

#include <algorithm>
#include <limits>

#include "lib/core/parallel.h"

namespace bp {

namespace {

constexpr std::size_t kFirst = 16;  // one in so many costs lies below the first bound
constexpr double kStep = 1.25;      // ratio of a bound to the one before
constexpr int kSteps = 200;

std::uint64_t faces_of(std::span<CostOrder* const> parts) {
  std::uint64_t n = 0;
  for (const CostOrder* part : parts) n += part->face_count();
  return n;
}

/// Returns rising bounds for the cost of one collapse; the last is infinite.
std::vector<double> steps_for(std::span<CostOrder* const> parts) {
  std::vector<std::vector<double>> of_part(parts.size());  // every kFirst-th cost of each part, sorted
  parallel_for(std::int64_t(parts.size()), [&](std::int64_t k) {
    const auto i = std::size_t(k);
    std::vector<double> all;
    parts[i]->add_costs(all);
    std::sort(all.begin(), all.end());
    for (std::size_t at = 0; at < all.size(); at += kFirst) of_part[i].push_back(all[at]);
  });
  std::vector<double> costs, steps;
  for (const std::vector<double>& some : of_part) costs.insert(costs.end(), some.begin(), some.end());
  std::sort(costs.begin(), costs.end());
  std::size_t first = costs.size() / kFirst;
  while (first < costs.size() && costs[first] <= 0) ++first;
  if (first < costs.size()) {
    for (double most = costs[first]; int(steps.size()) < kSteps; most *= kStep) steps.push_back(most);
  }
  steps.push_back(std::numeric_limits<double>::infinity());
  return steps;
}

}  // namespace

void take_cheapest(std::span<CostOrder* const> parts, std::uint64_t excess) {
  const std::uint64_t faces = faces_of(parts), enough = faces - std::min(faces, excess);
  for (const double most : steps_for(parts)) {
    std::vector<CostOrder*> waiting(parts.begin(), parts.end());  // parts that may have a collapse within the bound
    while (!waiting.empty()) {
      const std::uint64_t left = faces_of(parts);
      if (left <= enough) return;
      const std::vector<std::uint64_t> shares = shares_by_faces<CostOrder>(left - enough, waiting);
      std::vector<char> waits(waiting.size(), 1);
      parallel_for(std::int64_t(waiting.size()), [&](std::int64_t k) {
        const auto i = std::size_t(k);
        const std::uint64_t have = waiting[i]->face_count();
        if (shares[i] > 0) waits[i] = waiting[i]->run(most, have - std::min(have, shares[i]));
        if (waiting[i]->face_count() == 0) waits[i] = 0;
      });
      std::size_t kept = 0;
      for (std::size_t i = 0; i < waiting.size(); ++i) {
        if (waits[i]) waiting[kept++] = waiting[i];
      }
      waiting.resize(kept);
    }
  }
}

}  // namespace bp
