#pragma once
#include "lib/closing/closing.h"
#include "lib/closing/rotation.h"

/// The closing, straight from its definition (docs/pipeline.md, "The closing"): loops over all voxels in reach, no
/// cleverness. For small grids only.
namespace bp::reference {

/// `solid` without what lies outside of `box`.
[[nodiscard]] BitBox cut(const BitBox& solid, const VoxelBox& box);

/// D over `box`: the dilation of `solid`, outside of which everything is empty. `scale` covers `box`.
[[nodiscard]] BitBox dilate(const BitBox& solid, const ScaleLattice& scale, StructuringElement element,
                            const VoxelBox& box);

/// The same by cubes of an orientation of their own (lib/closing/rotation.h). `rotations` covers `box`.
[[nodiscard]] BitBox dilate_oriented(const BitBox& solid, const ScaleLattice& scale, const RotationLattice& rotations,
                                     const VoxelBox& box);
[[nodiscard]] BitBox close_oriented(const BitBox& solid, const ScaleLattice& scale, const RotationLattice& rotations,
                                    const VoxelBox& box);

/// E over `box`, all other voxels of the result empty. `scale` covers `box` grown by its largest sample + 2 voxels.
[[nodiscard]] BitBox close(const BitBox& solid, const ScaleLattice& scale, StructuringElement element,
                           const VoxelBox& box);

}  // namespace bp::reference
