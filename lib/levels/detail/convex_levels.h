#pragma once
#include <span>
#include <vector>

#include "lib/levels/detail/convex_level.h"

/// Convex meshes that may replace a bounding level: a box around the scene; for a flat scene also the prism around its
/// outline; for a convex one also its hull. They are exact for scenes of that shape, and a good choice for few faces.
namespace bp {

struct ConvexLevel {
  const char* way;  ///< "box", "prism" or "hull"
  LodLevel level;
};

/// Returns the convex meshes that have at most `faces` faces. Their error is not measured. `place`: a level without a
/// mesh; the results take its frame and scale. `bounds`: of everything that is enclosed; scene units. `corners`:
/// scene_corners(); empty if only voxels are known, and then there is a box only.
[[nodiscard]] std::vector<ConvexLevel> convex_levels(const LodLevel& place, const Bounds3d& bounds,
                                                     std::span<const Vec3d> corners, double off, std::uint64_t faces);

}  // namespace bp
