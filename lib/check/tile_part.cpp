#include "lib/check/tile_part.h"

#include <algorithm>
#include <numeric>

#include "lib/check/cover_tile.h"

namespace bp {

std::vector<bool> tiles_of(TilePart part, const std::vector<CoverTile>& tiles) {
  std::vector<std::size_t> depths(tiles.size()), order(tiles.size());
  for (std::size_t i = 0; i < tiles.size(); ++i) {  // children follow their parents
    for (const std::size_t child : tiles[i].children) depths[child] = depths[i] + 1;
  }
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const auto rank = [&](std::size_t i) { return std::pair(tiles[i].uri.empty(), depths[i]); };
    return rank(a) < rank(b);
  });
  std::vector<bool> mine(tiles.size());
  for (std::size_t i = 0; i < order.size(); ++i) {  // to and fro: the first part in one round is the last in the next
    const std::uint64_t turn = i % (2 * part.of);
    mine[order[i]] = std::min(turn, 2 * part.of - 1 - turn) == part.number;
  }
  return mine;
}

}  // namespace bp
