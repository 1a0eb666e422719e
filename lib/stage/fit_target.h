#pragma once
#include "lib/geometry/triangle_bvh.h"
#include "lib/meshing/fit.h"

/// Where the vertices of a fitted level of detail go.
namespace bp {

/// Half the extent of a voxel along the normal inwards: the surface of conservative voxels stands out that much on
/// average (a voxel is set if the surface comes within its half extent), and so does a closing's.
[[nodiscard]] FitTarget inset_target();

/// The nearest point of the scene if it is within 2.5 voxels, else inset_target(): the closing bridges something there.
/// `scene` must outlive the target.
[[nodiscard]] FitTarget scene_target(const TriangleBvh& scene, const GridFrame& frame);

/// The point of the closed triangle nearest to p, in floating point.
[[nodiscard]] Vec3d nearest_point(const Vec3d& p, const TriangleD& t);

}  // namespace bp
