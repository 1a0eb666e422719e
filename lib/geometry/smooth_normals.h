#pragma once
#include <array>
#include <span>
#include <vector>

#include "lib/core/coords.h"
#include "lib/core/packed_normal.h"

namespace bp {

/// Returns normals for the corners of triangles, to look at: smooth across edges that are bent by less than 40 degrees,
/// and not across sharper ones. Triangles with corners at the same place are neighbours, whether they share vertices or
/// not. Parallel. Memory: about 120 bytes a triangle, in addition to the result's 12.
[[nodiscard]] std::vector<std::array<PackedNormal, 3>> smooth_normals(std::span<const TriangleD> triangles);

}  // namespace bp
