#include "lib/pass/close/detail/tile_choice.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "lib/grid/brick.h"

namespace bp {

double tile_bytes(const VoxelCoord& grid, std::int32_t tile, const Halo& halo, bool turned) {
  const auto box_bytes = [&](std::int32_t margin) {
    double bytes = 1.0 / 8;
    for (int axis = 0; axis < 3; ++axis)
      bytes *= std::min(double(tile) + 2.0 * margin, double(grid[axis])) + (axis == 0 ? 126 : 0);
    return bytes;
  };
  const double solid = box_bytes(halo.total_vox()), dilation = box_bytes(halo.erosion_vox), core = box_bytes(0);
  const double side = std::min(double(tile) + 2.0 * halo.total_vox(), double(std::max({grid.x, grid.y, grid.z})));
  const double distances = 6 * (side + 160) * (side + 2);  // three slices of a varying cube dilation
  constexpr double kTransform = 8 << 20;                   // a block of rows of the ball transform
  // Turned cubes need their open voxels, and two sets of tables with 4 slices, whose rows are longer by two reaches.
  const double levels = std::bit_width(std::uint32_t(2 * halo.dilation_vox + 1));
  const double rows = turned ? 3 * dilation + (4 * levels + 8) / 8 * (side + 320) * (side + 24) : 0;
  const double cubes = turned ? double(turned_cubes_bytes(halo.dilation_vox)) : 0;
  return 3 * solid + 4 * dilation + 4 * core + distances + kTransform + rows + cubes;
}

std::int32_t choose_tile(const VoxelCoord& grid, const Halo& halo, std::size_t workers, std::uint64_t memory_bytes,
                         std::int32_t largest, bool turned) {
  std::int32_t best = kBrickEdge;
  double best_score = 0;
  for (std::int32_t tile = kBrickEdge; tile <= largest; tile += kBrickEdge) {
    const double fit = std::floor(double(memory_bytes) / tile_bytes(grid, tile, halo, turned));
    double count = 1;
    for (int axis = 0; axis < 3; ++axis) count *= std::ceil(double(grid[axis]) / tile);
    const double busy = std::min({double(workers), fit, std::max(1.0, count / 3)});
    const double share = double(tile) / (tile + halo.total_vox());
    const double score = busy * share * share;
    if (score > best_score) {
      best = tile;
      best_score = score;
    }
  }
  return best;
}

std::size_t left_of(std::uint64_t memory_bytes, double tile_bytes, std::size_t workers) {
  constexpr double kShare = 0.75;  // the lists of open voxels come on top
  return std::size_t(std::max(0.0, kShare * (double(memory_bytes) / double(workers) - tile_bytes)));
}

}  // namespace bp
