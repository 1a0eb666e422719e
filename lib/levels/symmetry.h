#pragma once
#include <optional>

#include "lib/grid/mirror_plane.h"
#include "lib/levels/level_chain.h"

/// Scenes that are their own mirror image, and voxels that are made so.
namespace bp {

/// The plane between voxels that is nearest to the middle of the scene.
[[nodiscard]] MirrorPlane middle_plane(const StreamHeader& header, int axis);

/// The first of the axes x, y, z across which the scene is its own mirror image, to two voxels: one for the plane,
/// which lies between voxels, and one for the voxels themselves.
[[nodiscard]] std::optional<MirrorPlane> symmetry_of(const VoxelizedScene& scene, const PassContext& context);

/// Adds the mirror image of the solid.
void add_image(VoxelizedScene& scene, const MirrorPlane& plane, const ShelfFactory& make_shelf);

}  // namespace bp
