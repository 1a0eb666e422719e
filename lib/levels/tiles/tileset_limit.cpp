#include "lib/levels/tiles/tileset_limit.h"

#include <algorithm>

#include "lib/volume/reduce.h"

namespace bp {

namespace {

std::uint64_t closing_limit(const TilesetCount& count, const CutLevel& cut) {
  return count.context.memory.limit_for(least_cell_bytes(count.cut.cells, cut.halo.total_vox()) + count.held_bytes);
}

/// Returns the triangles near the cells of a cut level.
std::function<std::uint64_t(CellCoord)> near_cells(const TilesetCount& count, std::size_t level) {
  if (count.triangles == 0) return {};
  return [&count, level](CellCoord cell) { return count.near ? count.near(level, cell) : count.triangles; };
}

std::uint64_t limit_of_tiles(const TilesetCount& count, std::size_t level, const StreamHeader& header,
                             const BrickShelf& solid) {
  const TileLevel uncut{header, solid, solid, solid, count.cut.cells};
  TileParams params = tile_params(count.plan, level, count.cut);
  params.scale_world = count.plan.cut[level].scale_world;
  return tiles_limit(uncut, params, count.context, count.held_bytes, near_cells(count, level));
}

}  // namespace

std::uint64_t tileset_limit(const TilesetCount& count, const StreamHeader& header, BrickShelf& solid,
                            std::size_t level) {
  const std::size_t cut = count.plan.cut.size();
  if (level >= cut)
    return count.plan.whole > 0 ? chain_limit(header, solid, count.whole, count.context, count.triangles) : 0;
  const auto coarser = count.context.make_shelf();
  reduce(solid, header.frame, *coarser);
  return std::max({closing_limit(count, count.plan.cut[level]), limit_of_tiles(count, level, header, solid),
                   tileset_limit(count, reduced(header), *coarser, level + 1)});
}

std::uint64_t tileset_limit(const TilesetCount& count, TilePyramid& pyramid) {
  std::uint64_t most = tileset_limit(count, pyramid.header(), pyramid.solid(), pyramid.level());
  const auto all = [&](CellCoord) { return count.triangles; };  // tasks have their scene, and count what is near
  for (const TileTask& task : pyramid.tasks())
    most = std::max(most, tiles_limit(task.level, task.params, count.context, count.held_bytes, all));
  return most;
}

}  // namespace bp
