#include "lib/grid/cells.h"

namespace bp {

namespace {

// A closing reaches one voxel beyond what it closes, and reductions round outwards.
constexpr std::int64_t kMarginVox = 2;

/// Where cells may begin below the ground: at places half a cell of level 0 apart at most, where all levels have whole
/// voxels. Next to 0, where the ground lies as a rule, it is half of that above one. `n`, `step`: of
/// aligned_to_cells().
std::int64_t place_below(std::int64_t ground, std::int32_t edge_vox, int n, std::int64_t step) {
  const std::int64_t unit = std::int64_t(1) << n, half = edge_vox / 2;
  const std::int64_t apart = std::clamp(half / unit * unit, unit, step << n);
  const std::int64_t zero = ceil_div(std::min(half, apart) / 2, unit) * unit;
  const std::int64_t margin = unit / 2 + 1;  // the coarsest level that is cut has voxels of half a unit
  return floor_div(ground - margin + zero, apart) * apart - zero;
}

}  // namespace

CellSpan cells_spanned(const Cells& cells, const VoxelBox& box) {
  return {cells.of(box.min), cells.of({box.max.x - 1, box.max.y - 1, box.max.z - 1})};
}

CellSpan cells_spanned(const Cells& cells, const BrickBox& bricks) {
  return cells_spanned(cells, voxels_of(bricks));
}

GridFrame aligned_to_cells(const GridFrame& frame, const Bounds3d& bounds, std::int32_t edge_vox) {
  const VoxelBox box = voxel_bounds(frame, bounds);
  const std::int64_t longest = std::max({box.size().x, box.size().y, box.size().z});
  const std::int64_t step = std::min(kBrickEdge, edge_vox / 2);
  int n = 0;
  while ((edge_vox - step - 2 * kMarginVox) << n < longest) ++n;
  const AxisTurn turn = to_y_up(frame.up);
  const auto up = turn.axis[1];
  GridFrame aligned = frame;
  for (std::size_t i = 0; i < 3; ++i) {
    std::int64_t& origin = aligned.origin[i];
    if (i != std::size_t(up) || n == 0) {
      origin = floor_div(origin - (kMarginVox << n), step << n) * (step << n);
    } else if (turn.negative[1]) {
      origin = -place_below(-(origin + box.max[up] - 1), edge_vox, n, step) - (std::int64_t(edge_vox) << n);
    } else {
      origin = place_below(origin, edge_vox, n, step);
    }
  }
  return aligned;
}

}  // namespace bp
