#pragma once
#include <array>
#include <vector>

#include "lib/grid/stream.h"

/// Streams that begin or end on shelves, so that passes run one after the other in one process.
namespace bp {

/// Puts the bricks of each layer onto its shelf. Bricks of a layer without a shelf are dropped.
class ShelfSink final : public BrickSink {
 public:
  explicit ShelfSink(BrickShelf* solid, BrickShelf* closing = nullptr) : shelves_{solid, closing} {}
  void write(const Brick& brick) override {
    if (BrickShelf* shelf = shelves_[std::size_t(brick.layer)]) shelf->put(brick.coord, brick.fill, brick.bits);
  }
  void finish() override {}

 private:
  std::array<BrickShelf*, 2> shelves_;
};

/// Reads the bricks of one or two shelves in slab order.
class ShelfSource final : public BrickSource {
 public:
  enum class Keep { all, solid };  ///< solid: bricks of the closing leave their shelf as they are read

  /// `closing` may be null. Each brick must lie in header.bricks. Keeps references.
  ShelfSource(StreamHeader header, BrickShelf& solid, BrickShelf* closing, Keep keep);

  [[nodiscard]] const StreamHeader& header() const override { return header_; }
  bool read(Brick& out) override;

 private:
  struct Place {
    BrickCoord coord;
    Layer layer;
  };
  StreamHeader header_;
  std::array<BrickShelf*, 2> shelves_;
  Keep keep_;
  std::vector<Place> places_;
  std::size_t next_ = 0;
};

}  // namespace bp
