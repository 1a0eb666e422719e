#include "lib/pass/close/detail/layer_writer.h"

#include <algorithm>

#include "lib/core/parallel.h"
#include "lib/pass/close/detail/tile_closer.h"

namespace bp {

namespace {

constexpr std::size_t kBricksAtATime = 128;  // bricks that are taken off the shelf together to be written: 8 MiB

void fetch(BrickShelf& shelf, BrickCoord c, Layer layer, Brick& out) {
  out.coord = c;
  out.layer = layer;
  out.fill = shelf.get(c, out.bits);
  if (out.fill != BrickFill::empty) shelf.drop(c);
}

}  // namespace

void LayerWriter::write(std::vector<BrickCoord> bricks) {
  const Stopwatch watch(seconds);
  std::sort(bricks.begin(), bricks.end(), [&](BrickCoord a, BrickCoord b) { return slab_order(axis_, a, b); });
  struct Layers {
    Brick solid, closing;
  };
  std::vector<Layers> some(std::min(bricks.size(), kBricksAtATime));
  for (std::size_t at = 0; at < bricks.size(); at += some.size()) {
    const std::size_t n = std::min(some.size(), bricks.size() - at);
    parallel_for(std::int64_t(n), [&](std::int64_t i) {
      const BrickCoord c = bricks[at + std::size_t(i)];
      fetch(solid_, c, Layer::solid, some[std::size_t(i)].solid);
      fetch(closing_, c, Layer::closing, some[std::size_t(i)].closing);
    });
    for (std::size_t i = 0; i < n; ++i) {
      for (const Brick* brick : {&some[i].solid, &some[i].closing}) {
        if (brick->fill == BrickFill::empty) continue;
        ++(brick->layer == Layer::solid ? solid_bricks : closing_bricks);
        sink_.write(*brick);
      }
    }
  }
}

}  // namespace bp
