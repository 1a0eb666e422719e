#include "lib/grid/cells.h"

namespace bp {

namespace {

// A closing reaches one voxel beyond the voxels that it closes, and reductions round outwards.
constexpr std::int64_t kMarginVox = 2;

/// The places where cells may begin along an axis: `zero` voxels below the scene's own origin, and every `apart` voxels
/// from there.
struct Places {
  std::int64_t margin, apart, zero;
  /// Returns the last place that leaves the margin to a scene that begins at `low`.
  [[nodiscard]] std::int64_t below(std::int64_t low) const {
    return floor_div(low - margin + zero, apart) * apart - zero;
  }
};

/// Returns the places upright. They are at most half a cell of level 0 apart, where all levels have whole voxels, so
/// that the ground lies in the lower part of a cell. The height 0, near which the ground usually lies, is between two
/// places. `n`, `step`: as aligned_to_cells() computes them.
Places places_upright(std::int32_t edge_vox, int n, std::int64_t step) {
  const std::int64_t unit = std::int64_t(1) << n, half = edge_vox / 2;
  const std::int64_t apart = std::clamp(half / unit * unit, unit, step << n);
  const std::int64_t zero = ceil_div(std::min(half, apart) / 2, unit) * unit;
  return {unit / 2 + 1, apart, zero};  // the coarsest level that is cut has voxels of half a unit
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
  GridFrame aligned = frame;
  for (int i = 0; i < 3; ++i) {
    std::int64_t& origin = aligned.origin[std::size_t(i)];
    const bool upright = i == turn.axis[1] && n > 0;
    const Places places = upright ? places_upright(edge_vox, n, step) : Places{kMarginVox << n, step << n, 0};
    if (upright && turn.negative[1]) {
      origin = -places.below(-(origin + box.max[i] - 1)) - (std::int64_t(edge_vox) << n);
    } else {
      origin = places.below(origin);
    }
  }
  return aligned;
}

}  // namespace bp
