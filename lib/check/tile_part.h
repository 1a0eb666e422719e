#pragma once
#include <cstdint>
#include <vector>

/// Divides a check into parts by its tiles.
namespace bp {

struct CoverTile;

constexpr std::uint64_t kMostTileParts = 65536;

/// The part of this number, counted from 0, among `of` parts.
struct TilePart {
  std::uint64_t number = 0, of = 1;
};

/// Returns for each tile (as for check_cover()) whether it belongs to the part. Each tile belongs to exactly one of the
/// parts, for any number of parts. Only the tree decides the division, since machines may see files differently. Tiles
/// are dealt out depth by depth, those with a content first. So neighbours go to different parts, which matters because
/// the work is concentrated in few places, and tiles of an upper depth take more.
[[nodiscard]] std::vector<bool> tiles_of(TilePart part, const std::vector<CoverTile>& tiles);

}  // namespace bp
