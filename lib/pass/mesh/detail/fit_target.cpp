#include "lib/pass/mesh/detail/fit_target.h"

#include <algorithm>
#include <cmath>

#include "lib/core/vec3.h"

namespace bp {

namespace {

constexpr double kReach = 2.5;  // voxels: a voxel's diagonal, twice its bias, and some

Vec3d inset(const Vec3d& p, const Vec3d& normal, double extents) {
  const double extent = std::abs(normal[0]) + std::abs(normal[1]) + std::abs(normal[2]);
  return p - extents * extent * kLatticePerVoxel * normal;
}

}  // namespace

FitTarget inset_target(double extents) {
  return [extents](const Vec3d& p, const Vec3d& normal) { return inset(p, normal, extents); };
}

FitTarget scene_target(const TriangleBvh& scene, const GridFrame& frame, double extents) {
  return [&scene, frame, extents](const Vec3d& p, const Vec3d& normal) {
    const Vec3d at = frame.world_origin() + frame.voxel / kLatticePerVoxel * p;
    const TriangleBvh::Nearest found = scene.nearest(at);
    if (found.distance_squared > kReach * kReach * frame.voxel * frame.voxel) return inset(p, normal, extents);
    return kLatticePerVoxel * frame.to_voxels(nearest_point(at, scene.item(found.item).corners));
  };
}

}  // namespace bp
