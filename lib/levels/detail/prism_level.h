#pragma once
#include <span>

#include "lib/levels/lod_level.h"

namespace bp {

/// The prism around a flat scene of `corners` (scene_corners()), which may be `off` lattice units, its sides a few
/// units away: its convex outline
/// in the plane that it lies in, as a level in the place of `level`. Of n corners it has 4 n - 4 triangles; an outline
/// of too many for `faces` is grown to fewer. Nothing if the scene is thicker than a voxel, if its outline is a needle,
/// has more than 4096 corners or does not grow to fewer (as a parallelogram, to three), or of fewer than 8 faces. Its
/// distances are not measured. O(n log n) of the scene's corners, and O(m^2) of the outline's.
[[nodiscard]] std::optional<LodLevel> prism_level(const LodLevel& level, std::span<const Vec3d> corners, double off,
                                                  std::uint64_t faces);

}  // namespace bp
