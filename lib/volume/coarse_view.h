#pragma once
#include <array>

#include "lib/grid/bit_box.h"
#include "lib/grid/brick.h"
#include "lib/grid/stream.h"

/// A grid of any size, made small enough to draw: a cell is occupied if one of its voxels is. For pictures only.
namespace bp {

class CoarseView {
 public:
  /// Cells are cubes of 2^k voxels, the smallest that cut the longest side of `bricks` into at most `max_cells`.
  explicit CoarseView(const BrickBox& bricks, std::int32_t max_cells = 256);

  void add(const Brick& brick);

  [[nodiscard]] std::int32_t cell_voxels() const { return cell_; }
  /// Returns the cells of a layer: cell (0,0,0) begins at voxel (0,0,0).
  [[nodiscard]] const BitBox& cells(Layer layer) const { return cells_[std::size_t(layer)]; }
  /// Returns the bounds of the occupied cells, in scene units; empty if there are none.
  [[nodiscard]] Bounds3d bounds(Layer layer, const GridFrame& frame) const;

 private:
  std::int32_t cell_ = 1;
  std::array<BitBox, 2> cells_;       ///< by Layer; in cells
  std::array<VoxelBox, 2> occupied_;  ///< by Layer: around the occupied cells
};

}  // namespace bp
