#pragma once
#include "lib/core/box.h"
#include "lib/core/grid_frame.h"

/// Cells: a grid cut into cubes. The voxels of a level of detail are twice those of the level before
/// (lib/volume/reduce.h), and eight cells of one level are one cell of the next. That is an octree without a list.
namespace bp {

using CellCoord = Coord3<struct CellSpace, std::int32_t>;  ///< cell of a level: voxels [edge c, edge c + edge)

struct Cells {
  std::int32_t edge_vox = 0;  ///< a multiple of 64, not 0; the same at all levels

  [[nodiscard]] CellCoord of(VoxelCoord p) const {
    return {floor_div(p.x, edge_vox), floor_div(p.y, edge_vox), floor_div(p.z, edge_vox)};
  }
  [[nodiscard]] VoxelBox box(CellCoord c) const {
    const VoxelCoord first{c.x * edge_vox, c.y * edge_vox, c.z * edge_vox};
    return {first, {first.x + edge_vox, first.y + edge_vox, first.z + edge_vox}};
  }
};

[[nodiscard]] inline CellCoord parent_of(CellCoord c) {
  return {floor_div(c.x, 2), floor_div(c.y, 2), floor_div(c.z, 2)};
}

/// Returns the voxels of twice the size that hold a voxel of `box`. Their grid has the same origin.
[[nodiscard]] inline VoxelBox halved(const VoxelBox& box) {
  VoxelBox half;
  for (int axis = 0; axis < 3; ++axis) {
    half.min[axis] = floor_div(box.min[axis], 2);
    half.max[axis] = ceil_div(box.max[axis], 2);
  }
  return half;
}

/// The box of cells from `first` to `last`.
struct CellSpan {
  CellCoord first{}, last{};
  [[nodiscard]] CellCoord size() const { return {last.x - first.x + 1, last.y - first.y + 1, last.z - first.z + 1}; }
  [[nodiscard]] std::uint64_t count() const {
    return std::uint64_t(size().x) * std::uint64_t(size().y) * std::uint64_t(size().z);
  }
  /// Returns the number of a cell of the span, in the span's order.
  [[nodiscard]] std::uint64_t index(CellCoord c) const {
    const CellCoord at = c - first;
    return (std::uint64_t(at.x) * std::uint64_t(size().y) + std::uint64_t(at.y)) * std::uint64_t(size().z) +
           std::uint64_t(at.z);
  }
};
/// Returns the cells that a box of voxels (not empty), or of bricks, meets.
[[nodiscard]] CellSpan cells_spanned(const Cells& cells, const VoxelBox& box);
[[nodiscard]] CellSpan cells_spanned(const Cells& cells, const BrickBox& bricks);

/// Returns the frame with its origin moved down so that cells of all levels fall on voxels and on each other. Let n be
/// the least number of reductions that bring the scene into one cell, and let a step be 64 voxels, or half of a smaller
/// cell. The origin is a multiple of 2^n steps from the scene's own origin, at least 2^(n+1) voxels below the bounds,
/// so a scene that grows a little keeps its cells. If n > 0, it is a multiple of 2^n voxels upright, at most half a
/// cell and half of 2^n below the ground (which is on top if up is a negative axis). So no level is cut closely above
/// the ground, unless 2^n is more than half a cell.
[[nodiscard]] GridFrame aligned_to_cells(const GridFrame& frame, const Bounds3d& bounds, std::int32_t edge_vox);

}  // namespace bp
