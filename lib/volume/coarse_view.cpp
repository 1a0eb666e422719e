#include "lib/volume/coarse_view.h"

#include <algorithm>

namespace bp {

namespace {

/// Makes the surface of the occupied cells of one layer.
class Faces {
 public:
  Faces(const BitBox& cells, std::int32_t cell, const GridFrame& frame) : cells_(cells), cell_(cell), frame_(frame) {}

  std::vector<TriangleD> all() {
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {-1, 1}) sweep(axis, side);
    }
    return std::move(out_);
  }

 private:
  /// Adds all faces whose outer normal is `side` along `axis`, in runs along another axis.
  void sweep(int axis, int side) {
    const int along = axis == 0 ? 1 : 0, across = 3 - axis - along;
    const VoxelBox& box = cells_.box();
    VoxelCoord p;
    for (p[axis] = box.min[axis]; p[axis] < box.max[axis]; ++p[axis]) {
      for (p[across] = box.min[across]; p[across] < box.max[across]; ++p[across]) {
        std::int32_t begin = box.min[along];
        for (p[along] = begin; p[along] <= box.max[along]; ++p[along]) {
          if (p[along] < box.max[along] && is_face(p, axis, side)) continue;
          if (begin < p[along]) add(p, axis, side, along, begin);
          begin = p[along] + 1;
        }
      }
    }
  }

  [[nodiscard]] bool is_face(VoxelCoord p, int axis, int side) const {
    if (!cells_.test(p)) return false;
    p[axis] += side;
    return !cells_.test(p);
  }

  /// Adds the rectangle of the cells from `begin` to p (excluded) along `along`.
  void add(VoxelCoord p, int axis, int side, int along, std::int32_t begin) {
    const int across = 3 - axis - along;
    const auto corner = [&](bool far_along, bool far_across) {
      VoxelCoord c = p;
      c[axis] += side > 0 ? 1 : 0;
      if (!far_along) c[along] = begin;
      if (far_across) c[across] += 1;
      const std::int64_t unit = std::int64_t(cell_) * kLatticePerVoxel;
      return frame_.world({c.x * unit, c.y * unit, c.z * unit});
    };
    const Vec3d a = corner(false, false), b = corner(true, false), c = corner(true, true), d = corner(false, true);
    // `along` x `across` points up `axis` if (axis, along, across) is an even permutation.
    const bool even = (along + 1) % 3 == across;
    if (even == (side > 0)) {
      out_.push_back({a, b, c});
      out_.push_back({a, c, d});
    } else {
      out_.push_back({a, c, b});
      out_.push_back({a, d, c});
    }
  }

  const BitBox& cells_;
  std::int32_t cell_;
  const GridFrame& frame_;
  std::vector<TriangleD> out_;
};

}  // namespace

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
        if ((row >> x & mask) != 0) cells.set(cell_of(x, y, z));
      }
    }
  }
}

std::vector<TriangleD> CoarseView::surface(Layer layer, const GridFrame& frame) const {
  return Faces(cells_[std::size_t(layer)], cell_, frame).all();
}

}  // namespace bp
