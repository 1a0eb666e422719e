#include "lib/closing/rotation.h"

#include <algorithm>

#include "lib/closing/detail/oriented_cube.h"

namespace bp {

std::int32_t oriented_reach(const OrientationField& field, Scale s) {
  std::int32_t most = 0;
  for (const FixedQuaternion& q : field.rotations)
    most = std::max(most, detail::cube_bounds(canonical(rotation_of(q))).reach(s));
  return most;
}

RotationLattice sample(const OrientationField& field, const VoxelBox& box) {
  RotationLattice out;
  for (int axis = 0; axis < 3; ++axis) {
    out.origin[axis] = floor_div(box.min[axis], kScaleStep);
    out.size[axis] = ceil_div(box.max[axis], kScaleStep) - out.origin[axis];
  }
  const VoxelCoord first = out.origin, n = out.size;
  for (VoxelCoord c = first; c.z < first.z + n.z; ++c.z) {
    for (c.y = first.y; c.y < first.y + n.y; ++c.y) {
      for (c.x = first.x; c.x < first.x + n.x; ++c.x)
        out.cells.push_back(rotation_of(field.rotations[field.index_at(c * kScaleStep)]));
    }
  }
  return out;
}

}  // namespace bp
