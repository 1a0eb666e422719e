#pragma once
#include <cstdint>
#include <vector>

/// The tiles that a part of a check is about.
namespace bp {

struct CoverTile;

constexpr std::uint64_t kMostTileParts = 65536;

/// One of `of` parts, from 0.
struct TilePart {
  std::uint64_t number = 0, of = 1;
};

/// For each tile (as for check_cover()) whether it lies in the part. Each tile lies in exactly one of the parts,
/// however many there are; which one depends on the tree alone, and not on files that machines may see differently. The
/// tiles are dealt out depth by depth, those with a content first, so that neighbours come to different parts: work
/// lies in few places, and more in a tile of an upper depth.
[[nodiscard]] std::vector<bool> tiles_of(TilePart part, const std::vector<CoverTile>& tiles);

}  // namespace bp
