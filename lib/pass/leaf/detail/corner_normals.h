#pragma once
#include <span>
#include <vector>

#include "lib/core/box.h"

namespace bp {

/// Returns, for each triangle's corners, the mean of the normals of faces there that lie within kCreaseDegrees of the
/// triangle's own, weighted by their angles. If too many faces meet at a corner, or if it lies outside of `box`, where
/// some faces are unknown, it is the triangle's own normal. O(n log n).
[[nodiscard]] std::vector<std::array<Vec3d, 3>> corner_normals(std::span<const TriangleD> triangles,
                                                               const Bounds3d& box);

}  // namespace bp
