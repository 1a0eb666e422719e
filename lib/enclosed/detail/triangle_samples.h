#pragma once
#include <cstdint>
#include <vector>

#include "lib/core/coords.h"

/// Sample points of triangles, which tell where a proxy must stay outside.
namespace bp {

constexpr std::int64_t kSamplesAtOnce = 1 << 14;  ///< samples that a thread makes at once

/// Appends the corners of the triangle and, for a large one, a grid of points inside.
void add_samples(const TriangleD& t, double voxel, std::vector<Vec3d>& points);

/// Returns the points sorted, each once. Parallel.
[[nodiscard]] std::vector<Vec3d> each_once(const std::vector<Vec3d>& points);

}  // namespace bp
