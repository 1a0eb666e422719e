#pragma once
#include "lib/levels/level_chain.h"

/// Keeps proxies at a distance from the scene: the scene's voxels are grown, and the proxy encloses the grown voxels.
namespace bp {

/// Grows the solid by voxels, so that every point nearer to the scene than `margin_world`, scene units, lies in the
/// open interior of the result. A mesh around the result keeps at least that distance from the scene (docs/bounding.md,
/// "Margin"). Throws bad_argument beyond kMostReach voxels, and out_of_resource. Cost: dilate_ball(). Returns the solid
/// as it was.
std::unique_ptr<BrickShelf> add_margin(VoxelizedScene& scene, double margin_world, const PassContext& context);

/// Returns the largest possible distance of a point of the grown voxels to the scene, scene units.
[[nodiscard]] double farthest_of_margin(double margin_world, double voxel);

}  // namespace bp
