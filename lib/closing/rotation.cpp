#include "lib/closing/rotation.h"

#include <algorithm>

namespace bp {

std::int32_t oriented_reach(const OrientationField& field, Scale s) {
  std::int32_t most = 0;
  for (const FixedQuaternion& q : field.rotations)
    most = std::max(most, cube_bounds(canonical(rotation_of(q))).reach(s));
  return most;
}

std::uint16_t CubesOver::at(VoxelCoord p) const {
  std::size_t i = 0;
  for (int axis = 2; axis >= 0; --axis) {
    const std::int32_t cell = std::clamp(floor_div(p[axis], edge) - origin[axis], 0, size[axis] - 1);
    i = i * std::size_t(size[axis]) + std::size_t(cell);
  }
  return cells[i];
}

CubesOver cubes_over(const OrientationField& field, const VoxelBox& region) {
  constexpr std::uint16_t kUnknown = OrientationField::kMostRotations;
  CubesOver cubes;
  cubes.edge = field.cell_vox;
  Box<OrientationCell> box;
  for (int axis = 0; axis < 3; ++axis) {
    const std::int32_t first = field.origin[axis], last = first + field.size[axis] - 1;
    box.min[axis] = std::clamp(floor_div(region.min[axis], cubes.edge), first, last);
    box.max[axis] = std::clamp(ceil_div(region.max[axis], cubes.edge) - 1, first, last) + 1;
  }
  cubes.origin = box.min;
  cubes.size = box.size();
  std::vector<std::uint16_t> number(field.rotations.size(), kUnknown);
  for_each(box, [&](OrientationCell c) {
    const OrientationCell at = c - field.origin;
    const std::uint16_t index =
        field.cells[(std::size_t(at.z) * std::size_t(field.size.y) + std::size_t(at.y)) * std::size_t(field.size.x) +
                    std::size_t(at.x)];
    if (number[index] == kUnknown) {
      number[index] = std::uint16_t(cubes.rotations.size());
      cubes.rotations.push_back(canonical(rotation_of(field.rotations[index])));
      const CubeBounds b = cube_bounds(cubes.rotations.back());
      cubes.widest = {cubes.widest.turned || b.turned, std::max(cubes.widest.row_sum, b.row_sum),
                      std::max(cubes.widest.column_sum, b.column_sum)};
    }
    cubes.cells.push_back(number[index]);
  });
  return cubes;
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
