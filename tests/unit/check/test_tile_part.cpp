#include <algorithm>
#include <map>
#include <random>

#include "lib/check/tile_cover.h"
#include "tests/catch.h"

using namespace bp;

namespace {

/// Checks that parts have equal shares: the number of tiles of one depth, with or without a content, differs by two at
/// most.
void check_shares(const std::vector<CoverTile>& tiles, std::uint64_t count) {
  std::vector<int> depths(tiles.size());
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    for (const std::size_t child : tiles[i].children) depths[child] = depths[i] + 1;
  }
  std::map<std::pair<bool, int>, std::vector<int>> shares;
  for (std::uint64_t k = 0; k < count; ++k) {
    const std::vector<bool> mine = tiles_of({k, count}, tiles);
    for (std::size_t i = 0; i < tiles.size(); ++i) {
      auto& of_depth = shares[{tiles[i].uri.empty(), depths[i]}];
      of_depth.resize(count);
      of_depth[k] += mine[i];
    }
  }
  for (const auto& [kind, share] : shares) {
    const auto [least, most] = std::minmax_element(share.begin(), share.end());
    CHECK(*most - *least <= 2);
  }
}

/// Grows a tile and those below it, depth first, each with a content or not.
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
    check_shares(tiles, count);
  }
}
