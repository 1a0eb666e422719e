#pragma once
#include <atomic>
#include <vector>

#include "lib/grid/stream.h"

namespace bp {

/// Takes bricks off the shelves of the solid and of the closing, and writes both layers. Every solid brick lies in the
/// closing.
class LayerWriter {
 public:
  LayerWriter(BrickShelf& solid, BrickShelf& closing, int slab_axis, BrickSink& sink)
      : solid_(solid), closing_(closing), axis_(slab_axis), sink_(sink) {}
  [[nodiscard]] bool holds(BrickCoord c) const { return closing_.fill(c) != BrickFill::empty; }
  /// Writes these bricks, in slab order.
  void write(std::vector<BrickCoord> bricks);

  std::uint64_t solid_bricks = 0, closing_bricks = 0;  ///< written
  std::atomic<double> seconds{0};

 private:
  BrickShelf &solid_, &closing_;
  const int axis_;
  BrickSink& sink_;
};

}  // namespace bp
