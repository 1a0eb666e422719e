#pragma once
#include <functional>
#include <memory>
#include <mutex>
#include <unordered_map>

#include "lib/core/box.h"
#include "lib/grid/coord_hash.h"
#include "lib/store/scratch.h"
#include "lib/voxel/color_sums.h"

/// The colours of a level's surface, out of core: sparse cells, gathered in any order, kept compressed by bricks.
namespace bp {

using ColorBrick = Coord3<struct ColorBrickSpace, std::int32_t>;  ///< cells [16 b, 16 b + 16): a brick of voxels

class ColorGrid {
 public:
  static constexpr std::int32_t kEdge = 16;  ///< cells along a side of a brick
  /// Returns a mask for a cell. It is 0 if nothing of it is seen from outside; otherwise it has kSeen, and a bit for
  /// each layer that is seen: 4 bits for each of kColorAxes. Bits times kAbove mark layers above a seen one.
  using Mask = std::function<std::uint32_t(ColorCell)>;
  static constexpr std::uint32_t kSeen = 1U << 31, kAbove = 1U << 12;

  /// Returns x + 16 (y + 16 z) in the brick.
  [[nodiscard]] static std::uint64_t index_in(ColorBrick brick, ColorCell c) {
    return std::uint64_t((c.x - brick.x * kEdge) + kEdge * ((c.y - brick.y * kEdge) + kEdge * (c.z - brick.z * kEdge)));
  }
  /// Returns the cell around `c` in the grid of cells twice as large.
  [[nodiscard]] static ColorCell half_of(ColorCell c) {
    return {floor_div(c.x, 2), floor_div(c.y, 2), floor_div(c.z, 2)};
  }

  /// memory_bytes: for cells that are not in the store yet. The store may be shared.
  ColorGrid(std::shared_ptr<Scratch> store, std::uint64_t memory_bytes);
  ~ColorGrid();
  ColorGrid(const ColorGrid&) = delete;
  ColorGrid& operator=(const ColorGrid&) = delete;

  /// Adds sums to the cells, and leaves `sums` empty. May be called on any thread.
  void add(std::vector<ColorCellSum>& sums);
  /// Ends the input after the last add(). Cells of which nothing is seen go. In the others, surfaces along an axis go
  /// if they lie in layers that are not seen, unless the cell has no other such surface. seen() makes the mask of a
  /// brick, on any thread.
  void finish(const std::function<Mask(ColorBrick)>& seen);

  // Valid after finish(), on any thread:
  [[nodiscard]] bool empty() const { return bricks_.empty(); }
  [[nodiscard]] bool all_white() const { return all_white_; }
  [[nodiscard]] std::uint64_t cells() const { return cells_; }
  /// Returns cells [min, max), in order of (z, y, x, side).
  [[nodiscard]] std::vector<CellColor> load(ColorCell min, ColorCell max) const;
  /// Returns a grid with cells twice as large: cell c of this grid lies in half_of(c).
  [[nodiscard]] std::unique_ptr<ColorGrid> reduced() const;
  /// Returns bounds: all cells lie in [first, second).
  [[nodiscard]] std::pair<ColorCell, ColorCell> bounds() const;

 private:
  struct Entry {
    std::uint64_t index = 0;  ///< (16 index_in() + side) 4 + layer
    ColorSum sum;
  };
  struct Brick {
    std::vector<Entry> entries;
    std::size_t merged = 0;  ///< number of entries that are sorted, each once
    std::vector<Scratch::Handle> chunks;
  };
  static void merge(std::vector<Entry>& entries);
  static void keep_seen(std::vector<Entry>& entries, ColorBrick coord, const Mask& seen);
  void spill();
  [[nodiscard]] std::vector<Entry> all_of(const Brick& brick) const;
  void each_sum(ColorBrick brick, const std::function<void(const ColorCellSum&)>& body) const;

  std::shared_ptr<Scratch> store_;
  std::uint64_t memory_bytes_, used_bytes_ = 0;
  std::mutex mutex_;
  std::unordered_map<ColorBrick, Brick, CoordHash> gathering_;
  std::vector<std::pair<ColorBrick, Scratch::Handle>> bricks_;  ///< sorted; after finish()
  bool all_white_ = true;
  std::uint64_t cells_ = 0;
};

}  // namespace bp
