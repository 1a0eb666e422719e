#pragma once
#include <optional>

#include "lib/grid/mirror_plane.h"
#include "lib/levels/level_chain.h"

/// Prepares the voxels of a scene for a cage: finds scenes that are their own mirror image, makes solids symmetric, and
/// grows them, so that a cage keeps its distance from the scene.
namespace bp {

/// Returns the plane between voxels that is nearest to the middle of the scene.
[[nodiscard]] MirrorPlane middle_plane(const StreamHeader& header, int axis);

/// Returns the first of the axes x, y, z across which the scene is its own mirror image, within two voxels: one because
/// the plane lies between voxels, and one because of the voxels themselves.
[[nodiscard]] std::optional<MirrorPlane> symmetry_of(const VoxelizedScene& scene, const PassContext& context);

/// Adds the mirror image of the solid.
void add_image(VoxelizedScene& scene, const MirrorPlane& plane, const ShelfFactory& make_shelf);

/// Grows the solid by voxels, so that every point nearer to the scene than `margin_world`, scene units, lies in the
/// open interior of the result. A mesh around the result keeps at least that distance from the scene (docs/bounding.md,
/// "Margin"). Throws bad_argument beyond kMostReach voxels, and out_of_resource. Cost: dilate_ball(). Returns the solid
/// as it was.
std::unique_ptr<BrickShelf> add_margin(VoxelizedScene& scene, double margin_world, const PassContext& context);

/// Returns the largest possible distance of a point of the grown voxels to the scene, scene units.
[[nodiscard]] double farthest_of_margin(double margin_world, double voxel);

}  // namespace bp
