#pragma once
#include <span>

#include "lib/grid/bit_box.h"
#include "lib/voxel/fixed_triangle.h"

/// The definition of conservative voxelization: thirteen separating axes, one cube at a time, no cleverness.
namespace bp::reference {

/// True if the closed cube [corner, corner + edge]^3, grown by `slack`, meets the closed triangle. Fixed-point
/// coordinates; the triangle's extent must stay below 2^40.
[[nodiscard]] bool meets(const FixedTriangle& triangle, const FixedPoint& corner, std::int64_t edge,
                         std::int64_t slack = kFixedSlack);

/// `out` with every voxel set that meets a triangle.
[[nodiscard]] BitBox voxelize(std::span<const FixedTriangle> triangles, BitBox out, std::int64_t slack = kFixedSlack);

}  // namespace bp::reference
