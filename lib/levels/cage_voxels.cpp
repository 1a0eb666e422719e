#include "lib/levels/cage_voxels.h"

#include <cmath>

#include "lib/core/error.h"
#include "lib/pass/mesh/complement.h"
#include "lib/volume/dilate_ball.h"
#include "lib/volume/mirror.h"

namespace bp {

namespace {

/// Replaces `scene.solid`, and grows `scene.header.bricks` to hold its bricks.
void put_solid(VoxelizedScene& scene, std::unique_ptr<BrickShelf> solid) {
  scene.solid = std::move(solid);
  scene.header.bricks = hull(scene.header.bricks, box_of_bricks(*scene.solid));
}

}  // namespace

MirrorPlane middle_plane(const StreamHeader& header, int axis) {
  const auto i = std::size_t(axis);
  const Vec3d min = header.frame.to_voxels(header.bounds.min), max = header.frame.to_voxels(header.bounds.max);
  return {axis, std::int32_t(std::lround((min[i] + max[i]) / 2))};
}

std::optional<MirrorPlane> symmetry_of(const VoxelizedScene& scene, const PassContext& context) {
  constexpr double kReach = 2;
  for (int axis = 0; axis < 3; ++axis) {
    const MirrorPlane plane = middle_plane(scene.header, axis);
    if (is_symmetric(*scene.solid, plane, kReach, context.make_shelf, context.memory)) return plane;
  }
  return std::nullopt;
}

void add_image(VoxelizedScene& scene, const MirrorPlane& plane, const ShelfFactory& make_shelf) {
  auto both = make_shelf();
  BrickBits bits;
  for (const BrickCoord& c : scene.solid->coords()) both->put(c, scene.solid->get(c, bits), bits);
  add_mirrored(*scene.solid, plane, *both);
  put_solid(scene, std::move(both));
}

std::unique_ptr<BrickShelf> add_margin(VoxelizedScene& scene, double margin_world, const PassContext& context) {
  constexpr double kRounding = 1 + 1e-12;  // rounding of the quotient and of squares
  const double reach = margin_world / scene.header.frame.voxel * kRounding;
  if (!(reach <= kMostReach))
    fail(ErrorCode::bad_argument, {Remedy::larger_voxels}, "a margin of {} is {:.0f} voxels, more than {}",
         margin_world, reach, kMostReach);
  auto grown = context.make_shelf();
  dilate_ball(*scene.solid, reach, *grown, context.memory, [&](std::uint64_t done, std::uint64_t total) {
    context.report("growing by the margin", "tiles", done, total);
  });
  std::unique_ptr<BrickShelf> before = std::move(scene.solid);
  put_solid(scene, std::move(grown));
  return before;
}

double farthest_of_margin(double margin_world, double voxel) {
  // The grown voxel holds the point, and the voxel that it is near to holds a point of the scene; each adds a diagonal.
  return margin_world + 2 * std::sqrt(3.0) * voxel;
}

}  // namespace bp
