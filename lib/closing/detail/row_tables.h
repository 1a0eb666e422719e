#pragma once
#include <vector>

#include "lib/closing/detail/oriented_cube.h"
#include "lib/grid/bit_box.h"

/// One slice of a box of voxels, made ready for the question: where does a row of voxels, moved along with 64 x 8
/// voxels at once, meet something?
namespace bp::detail {

class RowTables {
 public:
  static constexpr std::int32_t kRows = 8;

  /// A row of an element: two windows, each a power of two wide, that cover it. Each window is read from two words.
  struct Window {
    std::int32_t dy;
    std::int32_t word[4];         ///< from that of the asking voxels in the finest table
    std::uint8_t down[2], up[2];  ///< shifts
  };
  /// Up to kRows rows of an element's slice, next to each other.
  struct Group {
    std::int32_t count;
    std::uint32_t first;  ///< of the windows, one for each row
    Window some, all;     ///< what any of the rows holds, and what all hold; asked from kRows rows at once
    bool shares;          ///< kRows rows hold something in common
  };
  struct Element {
    CubeRows rows;
    std::vector<Window> windows;  ///< one for each of its rows
    std::vector<Group> groups;
    std::vector<std::uint32_t> slices;  ///< groups of slice dz: from number dz + most_dz to the next
    std::int32_t most_dz = 0;
    [[nodiscard]] std::size_t bytes() const {
      return windows.size() * (sizeof(Window) + sizeof(CubeRow)) + groups.size() * sizeof(Group);
    }
  };
  /// Of an element of this reach.
  static constexpr std::size_t most_bytes(std::int32_t reach) {
    const auto across = std::size_t(2 * reach + 1);
    return across * (across * (sizeof(Window) + sizeof(CubeRow)) + (across / kRows + 1) * sizeof(Group));
  }

  /// Lays tables for questions from voxels of `region` by elements of this reach.
  void lay(const VoxelBox& region, std::int32_t reach, std::int32_t longest);
  [[nodiscard]] Element prepare(CubeRows rows) const;

  /// Loads slice z of `solid`. False if nothing of it is in reach.
  bool load(const BitBox& solid, std::int32_t z);
  /// 64 x kRows voxels from (x, y) on, of which those from x + `first` to x + `last` ask elements of this reach. x: of
  /// whole words.
  struct Asking {
    std::int32_t x, y, first, last, reach;
  };
  /// Who asks from now on. False if nothing of the slice is in reach.
  bool look(const Asking& asking);
  /// Takes from left[i] the voxels of row y + i that slice dz of the element meets something from. All that is left
  /// asks.
  void ask(const Element& element, std::int32_t dz, std::uint64_t* left) const;

 private:
  [[nodiscard]] Window window(std::int32_t first, std::int32_t last, std::int32_t dy, bool wide) const;
  void add_groups(Element& element) const;
  [[nodiscard]] std::size_t level_words() const { return std::size_t(columns_) * std::size_t(height_); }

  VoxelBox region_;
  std::int32_t pad_ = 0;      ///< columns left and right of the region
  std::int32_t first_y_ = 0;  ///< of the tables
  std::int32_t columns_ = 0, height_ = 0, levels_ = 0;
  /// Level k: x to x + 2^k - 1 together; by columns, y fastest. Then the same of the rows y to y + kRows - 1 together.
  std::vector<std::uint64_t> tables_;
  Asking asking_{};
  std::vector<std::uint64_t> held_;  ///< of the rows y - reach to y + reach: not 0 if kRows from there hold something
};

}  // namespace bp::detail
