#include <algorithm>
#include <random>

#include "lib/check/tile_cover.h"
#include "tests/catch.h"

using namespace bp;

namespace {

/// A tile and those below it, depth first, each with a content or not.
void grow(std::vector<CoverTile>& tiles, int depth, std::mt19937& chance) {
  const std::size_t mine = tiles.size();
  tiles.push_back({"", chance() % 8 > 0 ? "uri" : "", {}, {}, {}});
  for (int i = 0; depth > 0 && i < 4; ++i) {
    tiles[mine].children.push_back(tiles.size());
    grow(tiles, depth - 1, chance);
  }
}

}  // namespace

TEST_CASE("each tile lies in one part of a check, and each part has its share of a depth", "[quick][check][tileset]") {
  std::mt19937 chance(1);
  std::vector<CoverTile> tiles;
  grow(tiles, int(GENERATE(0, 1, 4)), chance);
  for (const std::uint64_t count : {1, 2, 3, 7, 100}) {
    std::vector<int> times(tiles.size());
    std::vector<std::size_t> sizes;
    for (std::uint64_t k = 0; k < count; ++k) {
      const std::vector<bool> mine = tiles_of({k, count}, tiles);
      sizes.push_back(std::size_t(std::count(mine.begin(), mine.end(), true)));
      for (std::size_t i = 0; i < tiles.size(); ++i) times[i] += mine[i];
    }
    CHECK(std::all_of(times.begin(), times.end(), [](int n) { return n == 1; }));
    const auto [least, most] = std::minmax_element(sizes.begin(), sizes.end());
    CHECK(*most - *least <= 1);
  }
}
