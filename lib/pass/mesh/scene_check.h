#pragma once
#include <span>

#include "lib/core/triangle_source.h"
#include "lib/grid/stream.h"

/// Whether triangles are inside a set of voxels: what tightening against a scene must know before it begins.
namespace bp {

/// True if every voxel that voxelization would set for `triangles`, as the whole scene, is in `shelf`, so that each of
/// them lies strictly inside the voxels (docs/bounding.md, section 2). False if one is not, wherever it is. Cost: that
/// of voxelizing their surface, some triangles at a time in each brick that they meet.
[[nodiscard]] bool lies_within(std::span<const TriangleD> triangles, const Rounding& rounding, const GridFrame& frame,
                               const BrickShelf& shelf);
/// Throws bad_input if they do not lie within.
void require_within(std::span<const TriangleD> triangles, const Rounding& rounding, const GridFrame& frame,
                    const BrickShelf& shelf);

}  // namespace bp
