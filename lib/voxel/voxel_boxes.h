#pragma once
#include <span>

#include "lib/core/box.h"
#include "lib/voxel/fixed_triangle.h"

namespace bp {

/// The voxels whose closed, grown cubes meet the box of a triangle, for each triangle: voxel_range() in overlap.h.
/// Reads and computes four coordinates at a time.
void voxel_boxes(std::span<const TriangleD> triangles, const GridFrame& frame, std::int64_t slack, VoxelBox* out);

}  // namespace bp
