#pragma once
#include <span>

#include "lib/levels/lod_chain.h"

namespace bp {

/// The prism around a flat scene, by a few lattice units: its outline in the plane that it lies in, as a level in the
/// place of `level`. Nothing if the scene is thicker than a voxel, if its outline is a needle, or if the prism has more
/// than `faces` triangles. A triangle has 8, a convex polygon of n corners 4 n - 4. Its distances are not measured.
/// O(n log n).
[[nodiscard]] std::optional<LodLevel> prism_level(const LodLevel& level, std::span<const TriangleD> scene,
                                                  std::uint64_t faces);

}  // namespace bp
