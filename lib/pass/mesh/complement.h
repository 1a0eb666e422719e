#pragma once
#include "lib/grid/stream.h"

/// Makes the complement of sets of voxels. It serves two purposes: an opening is the complement of the closing of the
/// complement, and a proxy inside a solid is a proxy around its complement, with its faces turned over.
namespace bp {

/// Inverts each voxel of `bits`.
void turn(BrickBits& bits);

/// Reads the complement of another source's solid layer, within the brick box of the stream: each brick that is not
/// empty, as a solid layer in slab order. It reads brick by brick as `source` does.
class ComplementSource final : public BrickSource {
 public:
  explicit ComplementSource(BrickSource& source);
  [[nodiscard]] const StreamHeader& header() const override { return source_.header(); }
  bool read(Brick& out) override;

 private:
  BrickSource& source_;
  BrickCoord at_;  ///< next brick of the box
  Brick next_;     ///< a brick of the source's solid layer that was read, but not used yet
  bool left_ = true, more_ = true;
};

/// Writes the complements of both layers that are written to it, within the box and in the slab order of `header`. The
/// complement of the solid layer becomes the solid layer, and the complement of the closing layer becomes the opening.
/// Bricks outside the box are dropped. The written closing layer must contain the written solid layer.
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
  BrickCoord at_;         ///< next brick of the box
  bool left_ = true;      ///< at_ is in the box
  bool pending_ = false;  ///< solid_ waits for the closing of its brick
  Brick solid_, closing_;
};

/// Returns the box around the bricks of a shelf.
[[nodiscard]] BrickBox box_of_bricks(const BrickShelf& shelf);
/// Returns the same, grown by one brick on each side.
[[nodiscard]] BrickBox bricks_around(const BrickShelf& shelf);

/// Puts every voxel of `box` that is not in `shelf` into `out`.
void complement(const BrickShelf& shelf, const BrickBox& box, BrickShelf& out);

}  // namespace bp
