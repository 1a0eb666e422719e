#include "lib/stage/fit_target.h"

#include <algorithm>
#include <cmath>

#include "lib/meshing/lattice_geometry.h"

namespace bp {

namespace {

constexpr double kReach = 2.5;  // voxels: a voxel's diagonal, twice its bias, and some

Vec3d minus(const Vec3d& a, const Vec3d& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vec3d along(const Vec3d& p, const Vec3d& d, double t) {
  return {p[0] + t * d[0], p[1] + t * d[1], p[2] + t * d[2]};
}

Vec3d nearest_on_segment(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
  const Vec3d d = minus(b, a);
  const double l = dot(d, d);
  return l > 0 ? along(a, d, std::clamp(dot(minus(p, a), d) / l, 0.0, 1.0)) : a;
}

LatticeCoord inset(const LatticeCoord& p, const Vec3d& normal) {
  const double extent = std::abs(normal[0]) + std::abs(normal[1]) + std::abs(normal[2]);
  const double by = extent / 2 * kLatticePerVoxel;
  return {p.x - std::llround(by * normal[0]), p.y - std::llround(by * normal[1]), p.z - std::llround(by * normal[2])};
}

}  // namespace

Vec3d nearest_point(const Vec3d& p, const TriangleD& t) {
  const Vec3d u = minus(t[1], t[0]), v = minus(t[2], t[0]), w = minus(p, t[0]);
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w);
  const double det = uu * vv - uv * uv, s = vv * uw - uv * vw, r = uu * vw - uv * uw;
  if (det > 0 && s >= 0 && r >= 0 && s + r <= det) return along(along(t[0], u, s / det), v, r / det);
  Vec3d best = t[0];
  double least = HUGE_VAL;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d q = nearest_on_segment(p, t[k], t[(k + 1) % 3]);
    const double d = dot(minus(p, q), minus(p, q));
    if (d < least) least = d, best = q;
  }
  return best;
}

FitTarget inset_target() {
  return inset;
}

FitTarget scene_target(const TriangleBvh& scene, const GridFrame& frame) {
  return [&scene, frame](const LatticeCoord& p, const Vec3d& normal) {
    const Vec3d at = frame.world(p);
    const TriangleBvh::Nearest found = scene.nearest(at);
    if (found.distance_squared > kReach * kReach * frame.voxel * frame.voxel) return inset(p, normal);
    const Vec3d q = frame.to_voxels(nearest_point(at, scene.item(found.item).corners));
    return LatticeCoord{std::llround(q[0] * kLatticePerVoxel), std::llround(q[1] * kLatticePerVoxel),
                        std::llround(q[2] * kLatticePerVoxel)};
  };
}

}  // namespace bp
