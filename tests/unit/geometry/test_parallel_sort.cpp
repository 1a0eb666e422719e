#include <random>
#include <utility>

#include "lib/geometry/parallel_sort.h"
#include "tests/catch.h"

namespace bp::test {

namespace {

constexpr std::size_t kRun = 1 << 13;  // as in parallel_sort.h

}  // namespace

TEST_CASE("sorting on all threads gives what std::sort gives, for any length of runs", "[quick][core]") {
  const std::size_t n = GENERATE(std::size_t(0), std::size_t(1), kRun - 1, kRun, kRun + 1, 2 * kRun, 5 * kRun + 3);
  CAPTURE(n);
  std::mt19937 random(7);
  std::vector<std::pair<int, std::size_t>> items;
  for (std::size_t i = 0; i < n; ++i) items.emplace_back(int(random() % 100), i);
  auto expected = items;
  std::sort(expected.begin(), expected.end());
  parallel_sort(items, [](const auto& a, const auto& b) { return a < b; });
  CHECK(items == expected);
}

}  // namespace bp::test
