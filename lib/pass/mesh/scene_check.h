#pragma once
#include <span>

#include "lib/core/triangle_source.h"
#include "lib/grid/stream.h"

/// Checks that triangles lie inside a set of voxels, which tightening against a scene requires.
namespace bp {

/// Returns true if `shelf` has every voxel that voxelization would set for `triangles`: then each of them lies strictly
/// inside the voxels (docs/bounding.md, section 2). Returns false if it lacks one of them. Cost: voxelizing the
/// triangles' surface, in each brick for a share of them at a time.
[[nodiscard]] bool lies_within(std::span<const TriangleD> triangles, const Rounding& rounding, const GridFrame& frame,
                               const BrickShelf& shelf);
/// Throws bad_input unless lies_within().
void require_within(std::span<const TriangleD> triangles, const Rounding& rounding, const GridFrame& frame,
                    const BrickShelf& shelf);

}  // namespace bp
