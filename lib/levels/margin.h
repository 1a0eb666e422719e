#pragma once
#include "lib/levels/level_chain.h"

/// Room around a scene: its voxels are grown, and what encloses these keeps its distance from the scene.
namespace bp {

/// Grows the solid by voxels, so that every point nearer to the scene than `margin_world`, scene units, lies in the
/// open interior of the result: what encloses these voxels keeps at least that distance (docs/bounding.md, "Margin").
/// Throws bad_argument beyond kMostReach voxels, and out_of_resource. Cost: dilate_ball().
void add_margin(VoxelizedScene& scene, double margin_world, const PassContext& context);

/// How far a point of the grown voxels is from the scene, at most, scene units.
[[nodiscard]] double farthest_of_margin(double margin_world, double voxel);

}  // namespace bp
