#include "lib/pass/voxelize/detail/emit_bricks.h"

#include <algorithm>

#include "lib/core/parallel.h"
#include "lib/grid/clip.h"
#include "lib/grid/count_bits.h"

namespace bp {

namespace {

/// The tiles, and then the bricks, of one step along the slab axis.
struct Slab {
  std::vector<std::uint64_t> tiles;
  std::vector<BrickCoord> bricks;  // bricks with voxels, in slab order
};

void list_bricks(const ShelvedTiles& tiles, int slab_axis, Slab& slab) {
  for (const std::uint64_t tile : slab.tiles) {
    // Most tiles of a wide grid hold nothing, so bricks are asked only in tiles that hold something.
    if (!tiles.holds(tile)) continue;
    for_each_brick(tiles.grid.box(tiles.grid.coord(tile)), [&](BrickCoord c) {
      if (tiles.shelf.fill(c) != BrickFill::empty) slab.bricks.push_back(c);
    });
  }
  std::sort(slab.bricks.begin(), slab.bricks.end(),
            [&](BrickCoord p, BrickCoord q) { return slab_order(slab_axis, p, q); });
}

void emit(const Slab& slab, BrickShelf& shelf, BrickSink& sink, EmittedBricks& counts) {
  Brick brick;
  for (const BrickCoord c : slab.bricks) {
    brick.coord = c;
    brick.fill = shelf.get(c, brick.bits);
    shelf.drop(c);
    counts.solid_voxels += count_bits(std::as_bytes(std::span(brick.bits)));
    ++counts.bricks;
    if (brick.fill == BrickFill::full) ++counts.full_bricks;
    sink.write(brick);
  }
}

}  // namespace

EmittedBricks emit_bricks(const ShelvedTiles& tiles, int slab_axis, BrickSink& sink, const PassProgress& progress) {
  const TileCoord& count = tiles.grid.count;
  const int a = slab_axis == 0 ? 1 : 0, b = slab_axis == 2 ? 1 : 2;
  PassSteps steps(progress, "filling", "slabs", std::uint64_t(count[slab_axis]));
  EmittedBricks counts;
  TileCoord at{};
  pipeline<Slab>(
      2,
      [&](Slab& slab) {
        if (at[slab_axis] == count[slab_axis]) return false;
        for (at[b] = 0; at[b] < count[b]; ++at[b]) {
          for (at[a] = 0; at[a] < count[a]; ++at[a]) slab.tiles.push_back(tiles.grid.index(at));
        }
        ++at[slab_axis];
        return true;
      },
      [&](Slab& slab) {
        parallel_for(std::int64_t(slab.tiles.size()), [&](std::int64_t i) { tiles.fill(slab.tiles[std::size_t(i)]); });
        list_bricks(tiles, slab_axis, slab);
      },
      [&](Slab& slab) {
        emit(slab, tiles.shelf, sink, counts);
        steps.add(1);
      });
  return counts;
}

}  // namespace bp
