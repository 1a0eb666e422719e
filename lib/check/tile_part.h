#pragma once
#include <cstdint>
#include <vector>

/// The division of a check into parts: which tiles a part is about.
namespace bp {

struct CoverTile;

constexpr std::uint64_t kMostTileParts = 65536;

/// One of `of` parts, counted from 0.
struct TilePart {
  std::uint64_t number = 0, of = 1;
};

/// Returns for each tile (as for check_cover()) whether it belongs to the part. Each tile belongs to exactly one of the
/// parts, for any number of parts. The division depends only on the tree, not on files, which machines may see
/// differently. Tiles are dealt out depth by depth, those with a content first, so that neighbours come to different
/// parts: the work is in few places, and a tile of an upper depth has more.
[[nodiscard]] std::vector<bool> tiles_of(TilePart part, const std::vector<CoverTile>& tiles);

}  // namespace bp
