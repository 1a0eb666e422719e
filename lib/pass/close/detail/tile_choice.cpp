#include "lib/pass/close/detail/tile_choice.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "lib/grid/brick.h"
#include "lib/pass/close/detail/earlier_tiles.h"

namespace bp {

namespace {

constexpr std::int32_t kMaxTileVox = 512;  // beyond that, halos cost little and tiles get few

/// Returns the bytes that closing one tile of a grid takes if every voxel of tile and halo is occupied: the boxes of
/// close_tile(), and as much again as the tile itself for the components of its empty voxels.
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

/// Returns the bytes of a worker's share of the memory that its tile leaves.
std::size_t left_of(std::uint64_t memory_bytes, double tile_bytes, std::size_t workers) {
  constexpr double kShare = 0.75;  // the lists of open voxels come on top
  return std::size_t(std::max(0.0, kShare * (double(memory_bytes) / double(workers) - tile_bytes)));
}

[[noreturn]] void fail_memory(std::int32_t edge, const Halo& halo, double bytes, const MemoryShare& memory) {
  const auto needed = std::uint64_t(std::ceil(bytes));
  Remedies others{Remedy::larger_voxels, Remedy::smaller_scale};
  if (edge > kBrickEdge) others.push_back(Remedy::smaller_tiles);
  throw NeedsMemory(fmt::format("closing a tile of {} voxels with a halo of {}", edge, halo.total_vox()), needed,
                    memory.bytes, memory.limit_with(needed - memory.bytes), others);
}

}  // namespace

TilePlan plan_tiles(const VoxelBox& grid, const Halo& widest, bool turned, bool mostly_stays, std::size_t backends,
                    std::int32_t tile_vox, const MemoryShare& memory) {
  // A GPU has few backends: while they compute, the other threads label and shelve tiles.
  const std::size_t workers = std::max(backends, std::size_t(thread_count()));
  // Halos are cheap on a GPU, so that small tiles keep all threads busy.
  const bool small = backends < workers && widest.total_vox() <= kMaxTileVox / 8;
  const std::int32_t largest = mostly_stays ? EarlierTiles::kMostVox : small ? kMaxTileVox / 2 : kMaxTileVox;
  const std::int32_t edge =
      tile_vox != 0 ? tile_vox : choose_tile(grid.size(), widest, workers, memory.bytes, largest, turned);
  if (edge < 0 || edge % kBrickEdge != 0)
    fail(ErrorCode::bad_argument, "a tile of {} voxels a side is no multiple of {}", edge, kBrickEdge);
  const double bytes = tile_bytes(grid.size(), edge, widest, turned);
  if (bytes > double(memory.bytes)) fail_memory(edge, widest, bytes, memory);
  const TileGrid tiles(grid, edge);
  if (tiles.total() > TileGrid::kMostTiles)
    fail(ErrorCode::bad_argument, {Remedy::larger_tiles}, "the grid has {:.0f} tiles of {} voxels", tiles.total(),
         edge);
  const auto fit = std::size_t(std::max(1.0, std::min(double(workers), double(memory.bytes) / bytes)));
  // The rest of the memory is for the rows of turned cubes: the more cubes at once, the fewer sweeps over the solid.
  return {tiles, fit, turned ? turned_cubes_bytes(widest.dilation_vox) + left_of(memory.bytes, bytes, fit) : 0};
}

}  // namespace bp
