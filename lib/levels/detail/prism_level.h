#pragma once
#include <span>

#include "lib/levels/lod_level.h"

namespace bp {

/// Returns a prism around a flat scene of `corners` (scene_corners()), which may be off by `off` lattice units, as a
/// level in the place of `level`. Its ends are parallel to the scene's plane, its sides stand on the scene's convex
/// outline, and all lie a few lattice units away. An outline of n corners makes 4 n - 4 triangles; if these are more
/// than `faces`, the outline is grown to fewer corners. Returns nothing in these cases:
///   - the scene is thicker than a voxel;
///   - the outline is a needle, or has more than 4096 corners;
///   - it cannot be grown to so few corners, as a parallelogram cannot to three;
///   - `faces` is below 8.
/// The error is not measured. Takes O(n log n) for the scene's n corners, and O(m^2) for the outline's m.
[[nodiscard]] std::optional<LodLevel> prism_level(const LodLevel& level, std::span<const Vec3d> corners, double off,
                                                  std::uint64_t faces);

}  // namespace bp
