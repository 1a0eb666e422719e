#pragma once
#include <array>
#include <vector>

#include "lib/grid/bit_box.h"

namespace bp {

/// The blurred occupancy of a brick and its surroundings. Its level of one half is a smooth surface near the surface of
/// the voxels.
class BlurredBox {
 public:
  static constexpr int kReach = 5;           ///< a blurred value depends on so many voxels each way along each axis
  static constexpr int kApron = kReach + 1;  ///< so many voxels around the brick are needed
  static constexpr int kSide = kBrickEdge + 2 * kApron;

  /// `solid` holds the brick that begins at `first`, grown by kApron.
  void reset(const BitBox& solid, VoxelCoord first);

  /// At a corner of voxels, (0,0,0) to (64,64,64): the value, 0 outside to 1 inside, and its gradient per voxel.
  struct Level {
    float value;
    std::array<float, 3> gradient;
  };
  [[nodiscard]] Level at(int x, int y, int z) const;

 private:
  void blur_along(std::ptrdiff_t stride);
  std::vector<std::uint16_t> values_, other_;
};

}  // namespace bp
