#include <algorithm>
#include <numeric>
#include <set>

#include "lib/pass/turn.h"
#include "tests/catch.h"

namespace bp {

TEST_CASE("each turn has an order of its own, and turn 0 none", "[quick][cache]") {
  std::vector<int> plain(20);
  std::iota(plain.begin(), plain.end(), 0);
  std::set<std::vector<int>> orders;
  for (std::uint64_t turn = 0; turn < 10; ++turn) {
    std::vector<int> items = plain;
    put_in_turn(items, turn);
    CHECK((items == plain) == (turn == 0));
    orders.insert(items);
    std::sort(items.begin(), items.end());
    CHECK(items == plain);
  }
  CHECK(orders.size() == 10);
}

}  // namespace bp
