#include "lib/pass/mesh/detail/fit_target.h"

#include <cmath>

#include "lib/core/vec3.h"

namespace bp {

namespace {

constexpr double kReach = 2.5;  // in voxels: a voxel's diagonal, twice the bias of its surface, and some reserve
constexpr double kAlong = 0.5;  // cosine: at a corner of a box it is 0.58

Vec3d inset(const Vec3d& p, const Vec3d& normal, double extents) {
  const double extent = std::abs(normal[0]) + std::abs(normal[1]) + std::abs(normal[2]);
  return p - extents * extent * kLatticePerVoxel * normal;
}

/// Returns a place on a triangle. The surface runs along the triangle, or ends there, as at the edge of a plate.
FitPlace place_on(const TriangleD& t, const Vec3d& at, const Vec3d& normal) {
  const Vec3d n = cross(t[1] - t[0], t[2] - t[0]);
  const double size = length(n);
  if (!(size > 0)) return {at};
  if (std::abs(dot(n, normal)) > kAlong * size) return {at, 1 / size * n};
  return {at, {}, normal};
}

}  // namespace

FitTarget inset_target(double extents) {
  return [extents](const Vec3d& p, const Vec3d& normal) { return FitPlace{inset(p, normal, extents)}; };
}

FitTarget scene_target(const TriangleBvh& scene, const GridFrame& frame, double extents) {
  return [&scene, frame, extents](const Vec3d& p, const Vec3d& normal) -> FitPlace {
    const Vec3d at = frame.world_origin() + frame.voxel / kLatticePerVoxel * p;
    const TriangleBvh::Nearest found = scene.nearest(at);
    if (found.distance_squared > kReach * kReach * frame.voxel * frame.voxel) return {inset(p, normal, extents)};
    const TriangleD& t = scene.item(found.item).corners;
    return place_on(t, frame.to_lattice(nearest_point(at, t)), normal);
  };
}

}  // namespace bp
