#include "lib/grid/cells.h"

namespace bp {

namespace {

// A closing reaches one voxel beyond what it closes, and reductions round outwards.
constexpr std::int64_t kMarginVox = 2;

}  // namespace

CellSpan cells_spanned(const Cells& cells, const VoxelBox& box) {
  return {cells.of(box.min), cells.of({box.max.x - 1, box.max.y - 1, box.max.z - 1})};
}

CellSpan cells_spanned(const Cells& cells, const BrickBox& bricks) {
  return cells_spanned(cells, voxels_of(bricks));
}

GridFrame aligned_to_cells(const GridFrame& frame, const Bounds3d& bounds, std::int32_t edge_vox) {
  const VoxelCoord size = voxel_bounds(frame, bounds).size();
  const std::int64_t longest = std::max({size.x, size.y, size.z});
  const std::int64_t step = std::min(kBrickEdge, edge_vox / 2);
  int n = 0;
  while ((edge_vox - step - 2 * kMarginVox) << n < longest) ++n;
  GridFrame aligned = frame;
  for (std::int64_t& o : aligned.origin) o = floor_div(o - (kMarginVox << n), step << n) * (step << n);
  return aligned;
}

}  // namespace bp
