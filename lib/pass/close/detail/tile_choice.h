#pragma once
#include <cstddef>
#include <cstdint>

#include "lib/device/backend.h"

namespace bp {

constexpr std::int32_t kMaxTileVox = 512;  ///< beyond that, halos cost little and tiles get few

/// Returns the bytes that closing one tile of a grid takes if every voxel of tile and halo is occupied: the boxes of
/// close_tile(), and as much again as the tile itself for the components of its empty voxels.
[[nodiscard]] double tile_bytes(const VoxelCoord& grid, std::int32_t tile, const Halo& halo, bool turned);

/// Returns the tile size, up to `largest`, with the best product: of the workers that fit in memory and find enough
/// tiles, and of the share of the voxels they read that are not halo.
[[nodiscard]] std::int32_t choose_tile(const VoxelCoord& grid, const Halo& halo, std::size_t workers,
                                       std::uint64_t memory_bytes, std::int32_t largest, bool turned);

/// Returns the bytes of a worker's share of the memory that its tile leaves.
[[nodiscard]] std::size_t left_of(std::uint64_t memory_bytes, double tile_bytes, std::size_t workers);

}  // namespace bp
