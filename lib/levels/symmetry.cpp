#include "lib/levels/symmetry.h"

#include <cmath>

#include "lib/volume/mirror.h"

namespace bp {

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

}  // namespace bp
