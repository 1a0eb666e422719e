#pragma once
#include <cstdint>

namespace bp {

/// A column crosses a triangle in a tile. Tiles are at most 512 voxels a side.
struct Crossing {
  std::uint32_t x : 9;     ///< column, voxels from the tile's corner
  std::uint32_t y : 9;     ///< column
  std::uint32_t z : 10;    ///< first voxel whose centre is at or above the crossing; may be the tile's height: above it
  std::uint32_t down : 1;  ///< the triangle faces down: entering a body with outward faces, +1; else -1
};

}  // namespace bp
