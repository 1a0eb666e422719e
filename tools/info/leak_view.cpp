#include "tools/info/leak_view.h"

#include <algorithm>
#include <cmath>

#include "lib/core/vec3.h"

namespace bp {

namespace {

constexpr int kStep = 10;  // degrees between directions that are tried
constexpr int kMostElevation = 80;
constexpr double kBestAngle = 30, kBestElevation = 25;  // to the way through the opening; above the horizon
constexpr double kBestAzimuth = 35;                     // as a picture has without leaks
constexpr double kRise = 0.2, kTurn = 0.02;             // weights of the differences

/// Returns the direction to the viewer in the scene's axes, of length 1.
Vec3d to_viewer(double azimuth, double elevation, UpAxis up) {
  const double a = azimuth * (M_PI / 180), e = elevation * (M_PI / 180);
  return turned(Vec3d{std::sin(a) * std::cos(e), -std::cos(a) * std::cos(e), std::sin(e)}, UpAxis::z, up);
}

/// Returns whether no wall lies on the ray from the middle of a voxel. Steps are a quarter of a voxel.
bool is_free(const BitBox& walls, VoxelCoord from, const Vec3d& direction) {
  constexpr double kRayStep = 0.25;
  Vec3d p{from.x + 0.5, from.y + 0.5, from.z + 0.5};
  for (;;) {
    VoxelCoord v;
    for (int axis = 0; axis < 3; ++axis) v[axis] = std::int32_t(std::floor(p[std::size_t(axis)]));
    if (!walls.box().grown(2).contains(v)) return true;
    if (walls.test(v)) return false;
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] += kRayStep * direction[axis];
  }
}

}  // namespace

bool is_seen(const Leak& leak, const LeakView& view, const BitBox& walls, const GridFrame& frame) {
  return is_free(walls, leak.place, to_viewer(view.azimuth, view.elevation, frame.up));
}

LeakView view_of(const Leak& leak, const BitBox& walls, const GridFrame& frame) {
  Vec3d way{};
  for (int axis = 0; axis < 3; ++axis) way[std::size_t(axis)] = leak.outer[axis] - leak.inner[axis];
  const double length = std::max(1.0, std::hypot(way[0], way[1], way[2]));
  LeakView best;
  double least = 0;
  bool any = false;
  for (int elevation = -kMostElevation; elevation <= kMostElevation; elevation += kStep) {
    for (int azimuth = -180 + kStep / 2; azimuth < 180; azimuth += kStep) {
      const Vec3d d = to_viewer(azimuth, elevation, frame.up);
      const double cosine = (d[0] * way[0] + d[1] * way[1] + d[2] * way[2]) / length;
      const double angle = std::acos(std::clamp(cosine, -1.0, 1.0)) * (180 / M_PI);
      const double turn = 180 - std::abs(180 - std::abs(azimuth - kBestAzimuth));
      const double badness =
          std::abs(angle - kBestAngle) + kRise * std::abs(double(elevation) - kBestElevation) + kTurn * turn;
      const bool seen = is_free(walls, leak.place, d);
      if (any && (best.seen != seen ? best.seen : badness >= least)) continue;
      best = {double(azimuth), double(elevation), seen};
      least = badness;
      any = true;
    }
  }
  return best;
}

}  // namespace bp
