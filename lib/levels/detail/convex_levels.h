#pragma once
#include <span>
#include <vector>

#include "lib/levels/detail/convex_level.h"

/// Convex meshes in place of a bounding level: a box around all that is enclosed; of a flat scene also the prism around
/// its outline, and of a convex one its hull. They are exact where the scene is such a thing, and near where few faces
/// are asked for.
namespace bp {

struct ConvexLevel {
  const char* way;  ///< "box", "prism" or "hull"
  LodLevel level;
};

/// Returns those that have at most `faces` faces. Their error is not measured. `place`: a level without a mesh, whose
/// frame and scale they take. `bounds`: of what is enclosed; scene units. `corners`: scene_corners(), or none, if only
/// voxels are known. `off`: what corners may be off by, lattice units.
[[nodiscard]] std::vector<ConvexLevel> convex_levels(const LodLevel& place, const Bounds3d& bounds,
                                                     std::span<const Vec3d> corners, double off, std::uint64_t faces);

}  // namespace bp
