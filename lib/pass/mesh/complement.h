#pragma once
#include "lib/grid/stream.h"

/// The complement of sets of voxels: an opening is the complement of the closing of the complement, and a proxy inside
/// a solid is one around its complement, seen from the other side.
namespace bp {

/// `bits` with each voxel turned.
void turn(BrickBits& bits);

/// The bricks of the stream's brick box that its solid layer does not fill, as the solid layer of another. In slab
/// order, brick by brick as `source` delivers.
class ComplementSource final : public BrickSource {
 public:
  explicit ComplementSource(BrickSource& source);
  [[nodiscard]] const StreamHeader& header() const override { return source_.header(); }
  bool read(Brick& out) override;

 private:
  BrickSource& source_;
  BrickCoord at_;  ///< next in the box
  Brick next_;     ///< of the source, solid, not yet passed
  bool left_ = true, more_ = true;
};

/// Both layers of what is written, turned, within the box and the slab order of `header`: what the solid layer leaves
/// out becomes the solid layer, and so the closing layer becomes the opening. Bricks outside the box are dropped. The
/// closing layer that is written must contain the solid layer.
class ComplementSink final : public BrickSink {
 public:
  ComplementSink(BrickSink& sink, const StreamHeader& header);
  void write(const Brick& brick) override;
  void finish() override;  ///< writes the bricks that are left; leaves `sink` unfinished

 private:
  void advance_to(BrickCoord coord);
  void write_full(BrickCoord coord);
  void write_turned();

  BrickSink& sink_;
  const BrickBox box_;
  const int axis_;
  BrickCoord at_;         ///< next in the box
  bool left_ = true;      ///< at_ is in the box
  bool pending_ = false;  ///< solid_ waits for the closing of its brick
  Brick solid_, closing_;
};

/// The bricks of a shelf and those around them.
[[nodiscard]] BrickBox bricks_around(const BrickShelf& shelf);

/// Puts on `out` every voxel of `box` that is not on `shelf`.
void complement(const BrickShelf& shelf, const BrickBox& box, BrickShelf& out);

}  // namespace bp
