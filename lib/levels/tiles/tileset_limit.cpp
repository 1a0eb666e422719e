#include "lib/levels/tiles/tileset_limit.h"

#include <algorithm>
#include <cmath>

#include "lib/volume/reduce.h"

namespace bp {

namespace {

std::uint64_t closing_limit(const TilesetCount& count, const CutLevel& cut) {
  return count.context.memory.limit_for(least_cell_bytes(count.cut.cells, cut.halo.total_vox()) + count.held_bytes);
}

std::uint64_t limit_of_tiles(const TilesetCount& count, std::size_t level, const StreamHeader& header,
                             const BrickShelf& solid) {
  const TileLevel uncut{header, solid, solid, solid, count.cut.cells};
  return tiles_limit(uncut, tile_params(count.plan, level, count.cut), count.context, count.held_bytes,
                     count.near.empty() ? CellCounts{{}, count.triangles} : count.near[level]);
}

}  // namespace

void add_near(const CutLevel& level, const Cells& cells, const Bounds3d& triangle, CellCounts& counts) {
  constexpr std::uint64_t kVeryMany = 512;  // cells that a triangle is counted for one by one
  const std::int32_t reach = tile_reach(level.scale_world, level.frame.voxel) + 1;  // and a voxel for rounding
  const auto cell_of = [&](const Vec3d& p, std::int32_t by) {
    const Vec3d at = level.frame.to_voxels(p);
    VoxelCoord v;
    for (int i = 0; i < 3; ++i) v[i] = std::int32_t(std::clamp(std::floor(at[std::size_t(i)]), -1e9, 1e9)) + by;
    return cells.of(v);
  };
  const CellSpan span{cell_of(triangle.min, -reach), cell_of(triangle.max, reach)};
  if (span.count() > kVeryMany) {
    ++counts.everywhere;
    return;
  }
  for (std::int32_t z = span.first.z; z <= span.last.z; ++z)
    for (std::int32_t y = span.first.y; y <= span.last.y; ++y)
      for (std::int32_t x = span.first.x; x <= span.last.x; ++x) ++counts.of_cell[{x, y, z}];
}

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
  const CellCounts all{{}, count.triangles};  // tasks have their scene, and count what is near
  for (const TileTask& task : pyramid.tasks())
    most = std::max(most, tiles_limit(task.level, task.params, count.context, count.held_bytes, all));
  return most;
}

}  // namespace bp
