#include "lib/volume/coarse_view.h"

#include <algorithm>

namespace bp {

CoarseView::CoarseView(const BrickBox& bricks, std::int32_t max_cells) {
  std::int64_t longest = 0;
  for (int axis = 0; axis < 3; ++axis)
    longest = std::max(longest, (std::int64_t(bricks.max[axis]) - bricks.min[axis]) * kBrickEdge);
  while (longest / cell_ > max_cells) cell_ *= 2;
  if (bricks.empty()) return;
  VoxelBox cells;
  for (int axis = 0; axis < 3; ++axis) {
    cells.min[axis] = floor_div(first_voxel(bricks.min)[axis], cell_);
    cells.max[axis] = floor_div(first_voxel(bricks.max)[axis] - 1, cell_) + 1;
  }
  for (BitBox& layer : cells_) layer.reset(cells);
}

void CoarseView::add(const Brick& brick) {
  BitBox& cells = cells_[std::size_t(brick.layer)];
  VoxelBox& occupied = occupied_[std::size_t(brick.layer)];
  const VoxelCoord first = first_voxel(brick.coord);
  const auto cell_of = [&](std::int32_t x, std::int32_t y, std::int32_t z) {
    return VoxelCoord{floor_div(first.x + x, cell_), floor_div(first.y + y, cell_), floor_div(first.z + z, cell_)};
  };
  const std::int32_t step = std::min(cell_, kBrickEdge);  // voxels of a cell within this brick
  const std::uint64_t mask = step == 64 ? ~std::uint64_t(0) : (std::uint64_t(1) << step) - 1;
  for (std::int32_t z = 0; z < kBrickEdge; ++z) {
    for (std::int32_t y = 0; y < kBrickEdge; ++y) {
      const std::uint64_t row = brick.bits[std::size_t(z * kBrickEdge + y)];
      if (row == 0) continue;
      for (std::int32_t x = 0; x < kBrickEdge; x += step) {
        if ((row >> x & mask) == 0) continue;
        const VoxelCoord cell = cell_of(x, y, z);
        cells.set(cell);
        const VoxelBox one{cell, cell + VoxelCoord{1, 1, 1}};
        occupied = occupied.empty() ? one : hull(occupied, one);
      }
    }
  }
}

Bounds3d CoarseView::bounds(Layer layer, const GridFrame& frame) const {
  Bounds3d bounds;
  const VoxelBox& box = occupied_[std::size_t(layer)];
  if (box.empty()) return bounds;
  const std::int64_t unit = std::int64_t(cell_) * kLatticePerVoxel;
  for (const VoxelCoord c : {box.min, box.max}) bounds.add(frame.world({c.x * unit, c.y * unit, c.z * unit}));
  return bounds;
}

}  // namespace bp
