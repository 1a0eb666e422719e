#include "lib/quads/detail/units.h"

#include <algorithm>

#include "lib/grid/brick_voxels.h"

namespace bp {

Units units_of(const BrickShelf& voxels, const std::optional<MirrorPlane>& plane, std::int32_t rim) {
  Units units;
  const VoxelBox box = bounds_of_voxels(voxels);
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
