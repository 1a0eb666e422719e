#include "lib/quads/detail/units.h"

#include <algorithm>

#include "lib/grid/brick_voxels.h"

namespace bp {

namespace {

template <class Visit>
void for_each_voxel(const BrickShelf& shelf, const Visit& visit) {
  BrickBits bits;
  for (const BrickCoord& c : shelf.coords()) {
    (void)shelf.get(c, bits);
    for_each_voxel(bits, c, visit);
  }
}

VoxelBox box_of_voxels(const BrickShelf& shelf) {
  VoxelBox box;
  for_each_voxel(shelf, [&](const VoxelCoord& p) {
    if (box.empty()) box = {p, {p.x + 1, p.y + 1, p.z + 1}};
    for (int i = 0; i < 3; ++i) {
      box.min[i] = std::min(box.min[i], p[i]);
      box.max[i] = std::max(box.max[i], p[i] + 1);
    }
  });
  return box;
}

}  // namespace

Units units_of(const BrickShelf& voxels, const std::optional<MirrorPlane>& plane, std::int32_t rim) {
  Units units;
  const VoxelBox box = box_of_voxels(voxels);
  const VoxelCoord size = box.size();
  units.origin = box.min;
  if (plane) units.origin[plane->axis] = plane->at;
  units.edge = (std::max({size.x, size.y, size.z}) + kUnitsAlong - 1) / kUnitsAlong;
  units.box.min = units.unit(box.min);
  units.box.max = units.unit({box.max.x - 1, box.max.y - 1, box.max.z - 1}) + VoxelCoord{1, 1, 1};
  units.solid = Grid(units.box.grown(rim));
  for_each_voxel(voxels, [&](const VoxelCoord& p) { units.solid.at(units.unit(p)) = 1; });
  return units;
}

}  // namespace bp
