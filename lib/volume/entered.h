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

/// The most voxels that a body is high, in what bplod makes and bpcheck proves.
constexpr std::int32_t kMostBodyVox = 4000;

/// Returns how many voxels a body holds on each side of the one in its middle, along each axis. The body is an upright
/// box, `height_world` high, with its sides along the axes. Wherever a box of width w stands, it holds at least floor(w
/// / voxel) - 1 whole voxels in a row. So it holds 2 reach + 1 of them if reach is at most w / (2 voxel) - 1. At least
/// 0, and at most `size`, that of a box around the solid: each part of such a box that a larger body holds is held by
/// this one, too, and if the one takes a step along an axis, the other takes one or none.
[[nodiscard]] inline VoxelCoord body_reach(const GridFrame& frame, double height_world, VoxelCoord size) {
  const int up = to_y_up(frame.up).axis[1];
  VoxelCoord all;
  for (int axis = 0; axis < 3; ++axis) {
    const double width = axis == up ? height_world : height_world * kBodyWidth;
    all[axis] = std::int32_t(std::clamp(std::floor(width / (2 * frame.voxel)) - 1, 0.0, double(size[axis])));
  }
  return all;
}

/// Returns a box around the solid with room for middles of bodies outside, and at least `least` voxels, on each side.
[[nodiscard]] inline VoxelBox box_for_bodies(VoxelBox solid, VoxelCoord reach, std::int32_t least = 0) {
  for (int axis = 0; axis < 3; ++axis) {
    const std::int32_t margin = std::max(reach[axis] + 1, least);
    solid.min[axis] -= margin;
    solid.max[axis] += margin;
  }
  return solid;
}

/// Returns the voxels that bodies hold on their ways from outside: all voxels within `reach` of a middle. A middle has
/// no solid voxel within `reach`, and the outside reaches it over faces of middles. So none of the voxels is solid. The
/// box of `solid` must have an empty margin of more than the reach along each axis. Memory: three bits for each voxel.
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
