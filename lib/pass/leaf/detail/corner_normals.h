#pragma once
#include <span>
#include <vector>

#include "lib/core/box.h"

namespace bp {

/// Of each triangle's corners: the mean of the normals of faces there that lie within kCreaseDegrees of the triangle's
/// own, by their angles. Where too many faces meet, and at corners outside of `box`, where some are not known, the
/// triangle's own. O(n log n).
[[nodiscard]] std::vector<std::array<Vec3d, 3>> corner_normals(std::span<const TriangleD> triangles,
                                                               const Bounds3d& box);

}  // namespace bp
