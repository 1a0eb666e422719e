#pragma once
#include "lib/fit/fit.h"
#include "lib/geometry/triangle_bvh.h"

/// The targets that the vertices of a fit move to.
namespace bp {

/// Returns a target that lies inwards along the normal, by `extents` times the extent of a voxel in that direction.
[[nodiscard]] FitTarget inset_target(double extents);

/// Returns a target on the scene: its nearest point if that is within 2.5 voxels. Elsewhere the closing bridges a gap,
/// and the target is inset_target(extents). `scene` must outlive the target.
[[nodiscard]] FitTarget scene_target(const TriangleBvh& scene, const GridFrame& frame, double extents);

}  // namespace bp
