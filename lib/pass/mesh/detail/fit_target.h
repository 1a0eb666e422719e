#pragma once
#include "lib/fit/fit.h"
#include "lib/geometry/triangle_bvh.h"

/// Where the vertices of a fitted level of detail go.
namespace bp {

/// So many extents of a voxel along the normal inwards.
[[nodiscard]] FitTarget inset_target(double extents);

/// The nearest point of the scene if it is within 2.5 voxels, else inset_target(extents): the closing bridges something
/// there. `scene` must outlive the target.
[[nodiscard]] FitTarget scene_target(const TriangleBvh& scene, const GridFrame& frame, double extents);

}  // namespace bp
