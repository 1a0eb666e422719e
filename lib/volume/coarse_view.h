#pragma once
#include <array>
#include <vector>

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
  [[nodiscard]] bool empty(Layer layer) const { return cells_[std::size_t(layer)].count() == 0; }
  /// Returns the faces between occupied and empty cells, in scene units, counter-clockwise seen from outside. Faces in
  /// a row along the longer edge become one rectangle of two triangles.
  [[nodiscard]] std::vector<TriangleD> surface(Layer layer, const GridFrame& frame) const;

 private:
  std::int32_t cell_ = 1;
  std::array<BitBox, 2> cells_;  ///< by Layer; in cells
};

}  // namespace bp
