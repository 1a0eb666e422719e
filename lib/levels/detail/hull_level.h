#pragma once
#include <span>

#include "lib/levels/lod_level.h"

namespace bp {

/// Returns the convex hull of `corners` (scene_corners()), which may be off by `off` lattice units, grown by these and
/// a few more, as a level in the place of `level`. Returns nothing in these cases:
///   - the hull has more than `faces` or 16,384 faces;
///   - it is flat, or so thin that its corners would move by half a voxel;
///   - the scene has more than 65,536 triangles.
/// The error is not measured. Takes O(n log n) for n corners, and O(f^2) for f faces of the hull.
[[nodiscard]] std::optional<LodLevel> hull_level(const LodLevel& level, std::span<const Vec3d> corners, double off,
                                                 std::uint64_t faces);

}  // namespace bp
