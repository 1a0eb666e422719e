#pragma once
#include <optional>

#include "lib/grid/mirror_plane.h"
#include "lib/levels/level_chain.h"

/// Finds scenes that are their own mirror image, and makes solids symmetric.
namespace bp {

/// Returns the plane between voxels that is nearest to the middle of the scene.
[[nodiscard]] MirrorPlane middle_plane(const StreamHeader& header, int axis);

/// Returns the first of the axes x, y, z across which the scene is its own mirror image, within two voxels: one because
/// the plane lies between voxels, and one because of the voxels themselves.
[[nodiscard]] std::optional<MirrorPlane> symmetry_of(const VoxelizedScene& scene, const PassContext& context);

/// Adds the mirror image of the solid.
void add_image(VoxelizedScene& scene, const MirrorPlane& plane, const ShelfFactory& make_shelf);

}  // namespace bp
