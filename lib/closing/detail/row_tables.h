#pragma once
#include <vector>

#include "lib/closing/detail/oriented_cube.h"
#include "lib/grid/bit_box.h"

/// One slice of a box of voxels, made ready for the question: where does a row of voxels, moved along with 64 x 8
/// voxels at once, meet something? And the same for blocks of 8 x 8 rows, from 8 slices on.
namespace bp::detail {

class RowTables {
 public:
  static constexpr std::int32_t kRows = 8;

  /// A stretch of x: two windows, each a power of two wide, that cover it. Each window is read from two words.
  struct Window {
    std::int32_t word[4] = {};              ///< from that of the asking voxels in the finest table
    std::uint8_t down[2] = {}, up[2] = {};  ///< shifts
  };
  /// Blocks of one j, from the first to the last with rows: i from `first` on.
  struct Layer {
    std::int32_t first = 0, count = 0;
    std::size_t block = 0;
  };
  /// Rows [8 i, 8 i + 8) of slices [8 j, 8 j + 8) are a block.
  struct Element {
    CubeRows rows;
    std::vector<Window> windows;        ///< one for each of its rows
    std::vector<std::uint32_t> starts;  ///< for each slice and i: number of its first row
    std::vector<Layer> layers;          ///< for each j
    std::vector<Window> blocks;         ///< those of the layers, one after the other: what any of a block's rows holds
    std::int32_t most_dz = 0;
    std::int32_t first = 0, across = 0;  ///< least i and j, and how many there are
    [[nodiscard]] std::size_t bytes() const {
      return windows.size() * (sizeof(Window) + sizeof(CubeRow)) + starts.size() * sizeof(std::uint32_t) +
             blocks.size() * sizeof(Window) + layers.size() * sizeof(Layer);
    }
  };
  /// Of an element of this reach.
  static constexpr std::size_t most_bytes(std::int32_t reach) {
    const auto side = std::size_t(2 * reach + 1), across = side / kRows + 2;
    return side * side * (sizeof(Window) + sizeof(CubeRow)) + side * across * sizeof(std::uint32_t) +
           across * (across * sizeof(Window) + sizeof(Layer));
  }

  /// Lays tables for questions from voxels of `region` by elements of this reach.
  void lay(const VoxelBox& region, std::int32_t reach, std::int32_t longest);
  [[nodiscard]] Element prepare(CubeRows rows) const;

  /// Loads slice z of `solid`, and the 7 behind it. False if nothing of them is in reach.
  bool load(const BitBox& solid, std::int32_t z);
  /// 64 x kRows voxels from (x, y) on ask from now on. x: of whole words.
  void place(std::int32_t x, std::int32_t y);
  /// The blocks from slice dz on, a multiple of 8, in which some of the `left` voxels may meet something. For ask().
  [[nodiscard]] std::uint64_t near(const Element& element, std::int32_t dz, const std::uint64_t* left) const;
  /// Takes from left[i] the voxels of row y + i that slice dz of the element, in the blocks `near`, meets something
  /// from.
  void ask(const Element& element, std::int32_t dz, std::uint64_t near, std::uint64_t* left) const;

 private:
  enum Tables { kSlice, kBlocks };
  [[nodiscard]] Window window(std::int32_t first, std::int32_t last, std::int32_t dy, Tables of) const;
  void add_blocks(Element& element) const;
  bool load_slice(const BitBox& solid, std::int32_t z, std::uint64_t* to) const;
  /// Level k of tables: x to x + 2^k - 1 together; by columns, y fastest.
  [[nodiscard]] std::size_t level(Tables of, std::int32_t k) const {
    return std::size_t(of * levels_ + k) * level_words();
  }
  void double_along(Tables of);
  [[nodiscard]] std::size_t level_words() const { return std::size_t(columns_) * std::size_t(height_); }
  /// Words that begin a line of the cache, as do those 8 rows further.
  class Lines {
   public:
    void assign(std::size_t n) { words_.assign(n + kRows, 0); }
    [[nodiscard]] std::uint64_t* data() {
      return words_.data() + (0 - reinterpret_cast<std::uintptr_t>(words_.data())) / 8 % kRows;
    }
    [[nodiscard]] const std::uint64_t* data() const { return const_cast<Lines*>(this)->data(); }

   private:
    std::vector<std::uint64_t> words_;
  };

  VoxelBox region_;
  std::int32_t pad_ = 0;      ///< columns left and right of the region
  std::int32_t first_y_ = 0;  ///< of the tables
  std::int32_t columns_ = 0, height_ = 0, levels_ = 0;
  std::int32_t most_blocks_ = 0, shared_bits_ = 0;  ///< bit of blocks i in near(): (i + most_blocks_) >> shared_bits_
  Lines tables_;                                    ///< of the slice; of 8 rows of 8 slices together
  Lines slices_;                                    ///< slice z is number z modulo 8
  std::int32_t next_ = 0;                           ///< slice that is not in them yet
  bool held_[kRows] = {}, loaded_ = false;          ///< what of them holds something
  bool here_ = false;                               ///< the slice itself does
  std::size_t at_ = 0;                              ///< of who asks, in the finest table
};

}  // namespace bp::detail
