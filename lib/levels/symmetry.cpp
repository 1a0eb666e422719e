#include "lib/levels/symmetry.h"

#include <cmath>

#include "lib/volume/mirror.h"

namespace bp {

MirrorPlane middle_plane(const StreamHeader& header, int axis) {
  const auto i = std::size_t(axis);
  const Vec3d min = header.frame.to_voxels(header.bounds.min), max = header.frame.to_voxels(header.bounds.max);
  return {axis, std::int32_t(std::lround((min[i] + max[i]) / 2))};
}

std::optional<MirrorPlane> symmetry_of(const VoxelizedScene& scene, const ShelfFactory& make_shelf) {
  constexpr double kReach = 2;
  for (int axis = 0; axis < 3; ++axis) {
    const MirrorPlane plane = middle_plane(scene.header, axis);
    if (is_symmetric(*scene.solid, plane, kReach, make_shelf)) return plane;
  }
  return std::nullopt;
}

void add_image(VoxelizedScene& scene, const MirrorPlane& plane, const ShelfFactory& make_shelf) {
  auto both = make_shelf();
  BrickBits bits;
  for (const BrickCoord& c : scene.solid->coords()) both->put(c, scene.solid->get(c, bits), bits);
  add_mirrored(*scene.solid, plane, *both);
  scene.solid = std::move(both);
  widen_bricks(scene);
}

void widen_bricks(VoxelizedScene& scene) {
  for (const BrickCoord& c : scene.solid->coords())
    scene.header.bricks = hull(scene.header.bricks, BrickBox{c, {c.x + 1, c.y + 1, c.z + 1}});
}

}  // namespace bp
