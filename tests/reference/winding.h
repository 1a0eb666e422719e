#pragma once
#include <span>

#include "lib/core/coords.h"

namespace bp::reference {

/// Winding number of a closed mesh around a point off its surface: the sum of the solid angles, over 4 pi.
[[nodiscard]] double winding_number(std::span<const TriangleD> triangles, const Vec3d& point);

}  // namespace bp::reference
