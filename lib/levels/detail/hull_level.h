#pragma once
#include <span>

#include "lib/levels/lod_level.h"

namespace bp {

/// The convex hull of `corners` (scene_corners()), which may be `off` lattice units, grown by that and a few units, as
/// a level in the place of `level`. Nothing if it has more than `faces` or 16,384, if it is flat, or so thin that its
/// corners would move by half a voxel, or if the scene has more than 65,536 triangles. Its distances are not measured.
/// O(n log n), and the square of its faces.
[[nodiscard]] std::optional<LodLevel> hull_level(const LodLevel& level, std::span<const Vec3d> corners, double off,
                                                 std::uint64_t faces);

}  // namespace bp
