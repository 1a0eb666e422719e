#pragma once
#include <cstdint>
#include <vector>

#include "lib/core/coords.h"

/// Points of triangles that tell where a proxy must stay outside.
namespace bp {

constexpr std::int64_t kSamplesAtOnce = 1 << 14;  ///< of a thread

/// The corners, and inside a large triangle a grid of points.
void add_samples(const TriangleD& t, double voxel, std::vector<Vec3d>& points);

/// Sorted, each once. Parallel.
[[nodiscard]] std::vector<Vec3d> each_once(const std::vector<Vec3d>& points);

}  // namespace bp
