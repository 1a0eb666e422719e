#pragma once
#include <algorithm>

#include "lib/core/box.h"

/// A grid of voxels cut into cubic tiles, counted from its least corner; the last ones are cut off at its border.
namespace bp {

struct TileGrid {
  /// Fills and closings visit every tile; beyond, a grid is a slip of the finger.
  static constexpr double kMostTiles = 1 << 27;
  VoxelBox voxels;
  std::int32_t edge_vox = 0;  ///< a multiple of kBrickEdge where tiles are stored as bricks
  TileCoord count{};

  TileGrid() = default;
  TileGrid(const VoxelBox& box, std::int32_t edge) : voxels(box), edge_vox(edge) {
    for (int axis = 0; axis < 3; ++axis) {
      const std::int64_t side = std::int64_t(box.max[axis]) - box.min[axis];
      count[axis] = std::int32_t((side + edge - 1) / edge);
    }
  }
  [[nodiscard]] double total() const { return double(count.x) * count.y * count.z; }
  [[nodiscard]] std::uint64_t index(TileCoord t) const {
    return std::uint64_t(t.x) +
           std::uint64_t(count.x) * (std::uint64_t(t.y) + std::uint64_t(count.y) * std::uint64_t(t.z));
  }
  [[nodiscard]] TileCoord coord(std::uint64_t i) const {
    const std::uint64_t nx = std::uint64_t(count.x), ny = std::uint64_t(count.y);
    return {std::int32_t(i % nx), std::int32_t(i / nx % ny), std::int32_t(i / nx / ny)};
  }
  [[nodiscard]] VoxelCoord first_voxel(TileCoord t) const {
    return {voxels.min.x + t.x * edge_vox, voxels.min.y + t.y * edge_vox, voxels.min.z + t.z * edge_vox};
  }
  [[nodiscard]] VoxelBox box(TileCoord t) const {
    const VoxelCoord first = first_voxel(t);
    VoxelBox b{first, first};
    for (int axis = 0; axis < 3; ++axis) {
      b.max[axis] = std::int32_t(std::min<std::int64_t>(std::int64_t(first[axis]) + edge_vox, voxels.max[axis]));
    }
    return b;
  }
  /// The tiles that hold a voxel of `in`, which lies in the grid and is not empty.
  [[nodiscard]] Box<TileCoord> tiles_of(const VoxelBox& in) const {
    Box<TileCoord> tiles;
    for (int axis = 0; axis < 3; ++axis) {
      tiles.min[axis] = (in.min[axis] - voxels.min[axis]) / edge_vox;
      tiles.max[axis] = (in.max[axis] - 1 - voxels.min[axis]) / edge_vox + 1;
    }
    return tiles;
  }
};

}  // namespace bp
