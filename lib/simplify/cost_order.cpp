#include "lib/simplify/cost_order.h"

#include <algorithm>
#include <limits>

#include "lib/core/parallel.h"

namespace bp {

namespace {

constexpr std::size_t kFirst = 16;  // steps of the cost begin where one in so many costs less
constexpr double kStep = 1.25;      // from one to the next
constexpr int kSteps = 200;

std::uint64_t faces_of(std::span<CostOrder* const> parts) {
  std::uint64_t n = 0;
  for (const CostOrder* part : parts) n += part->face_count();
  return n;
}

/// What one collapse may cost, rising; at last, anything.
std::vector<double> steps_for(std::span<CostOrder* const> parts) {
  std::vector<std::vector<double>> of_part(parts.size());  // one in kFirst, by rank
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
    std::vector<CostOrder*> waiting(parts.begin(), parts.end());  // that may have something for so little
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
