#pragma once
#include <algorithm>
#include <cmath>

#include "lib/core/grid_frame.h"
#include "lib/grid/bit_box.h"
#include "lib/volume/dilate.h"

/// Where somebody gets to who walks or flies into a scene.
namespace bp {

/// The width and the depth of a body over its height: 0.6 m with elbows for 1.8 m. Doors are wider, and nearly all
/// windows are less high than a body.
constexpr double kBodyWidth = 1.0 / 3;

/// Returns how many voxels a body holds on each side of the one in its middle, along each axis. The body is an upright
/// box, `height_world` high. A box of width w holds w / voxel - 1 whole voxels or more in a row, wherever it stands. So
/// it holds 2 reach + 1 of them if reach is at most w / (2 voxel) - 1. At least 0.
[[nodiscard]] inline VoxelCoord body_reach(const GridFrame& frame, double height_world) {
  constexpr double kMost = 1 << 20;  // no grid of bits is so wide
  const auto reach = [&](double width) {
    return std::int32_t(std::clamp(std::floor(width / (2 * frame.voxel)) - 1, 0.0, kMost));
  };
  const std::int32_t side = reach(height_world * kBodyWidth);
  VoxelCoord all{side, side, side};
  all[to_y_up(frame.up).axis[1]] = reach(height_world);
  return all;
}

/// Returns the voxels that bodies hold on their ways from outside: all voxels within `reach` of a middle. A middle has
/// no solid voxel within `reach`, and the outside reaches it over faces of middles. So none of the voxels is solid. The
/// box of `solid` must have an empty margin of more than the largest reach. Memory: three bits for each voxel.
[[nodiscard]] inline BitBox entered_voxels(const BitBox& solid, VoxelCoord reach) {
  BitBox middles = solid, entered(solid.box());
  dilate(middles, reach);
  for (std::int64_t i = 0; i < middles.word_count(); ++i) middles.data()[i] = ~middles.data()[i];
  entered.set(solid.box().min);
  grow_within(middles, entered);
  middles = {};
  dilate(entered, reach);
  return entered;
}

}  // namespace bp
