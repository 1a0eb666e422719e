#pragma once
#include <bit>
#include <vector>

#include "lib/closing/detail/oriented_cube.h"
#include "lib/grid/bit_box.h"

/// One slice of a box of voxels, made ready for the question: where does a row of voxels, moved along with 16 x 16
/// voxels at once, meet something? And the same for blocks of 4 x 4 rows, from 4 slices on. A row is two windows, each
/// a power of two wide. The tables have 32 voxels from every 16th on, so that a window is read from one word of each of
/// the 16 rows.
namespace bp::detail {

class RowTables {
 public:
  static constexpr std::int32_t kAcross = 16;               ///< voxels that ask, in a row and rows
  static constexpr std::int32_t kSlices = CubeRows::kEdge;  ///< that are joined
  /// Of a row of some length: where the tables of windows of 2^k voxels begin, the longest that fit in it; and 2^k.
  struct Windows {
    std::int32_t begin, voxels;
  };
  struct Asker;
  using Word = std::uint32_t;  ///< who asks uses the lower half

  /// Lays tables for questions from voxels of `region` by cubes of this reach.
  void lay(const VoxelBox& region, std::int32_t reach);

  /// Loads slice z of `solid`, and the 3 behind it. False if nothing of them is in reach.
  bool load(const BitBox& solid, std::int32_t z);
  /// kAcross x kAcross voxels from (x, y) on ask from now on. x and y: multiples of kAcross.
  void place(std::int32_t x, std::int32_t y);
  /// The blocks from slice dz on, a multiple of 4, in which some of the voxels that are `open`, of the `mask`, may meet
  /// something. For ask().
  [[nodiscard]] std::uint64_t near(const CubeRows& cube, std::int32_t dz, const Word* mask, const Word* open) const;
  /// Takes from open[i], of the `mask`, the voxels of row y + i that slice dz of the cube, in the blocks `near`, meets
  /// something from. False if there are none.
  bool ask(const CubeRows& cube, std::int32_t dz, std::uint64_t near, const Word* mask, Word* open) const;
  /// The same, row by row: take(dy, row, met) for each row that some meet something of; it may change what is open.
  template <class Take>
  void ask_each(const CubeRows& cube, std::int32_t dz, std::uint64_t near, const Word* mask, const Word* open,
                const Take& take) const {
    for_runs(cube, dz, near, [&](const CubeRows::Stretch& run) {
      for (std::int32_t dy = run.begin; dy < run.end; ++dy) {
        Word met[kAcross];
        if (meet(run.rows[dy - run.begin], dy, mask, open, met)) take(dy, run.rows[dy - run.begin], met);
      }
    });
  }

 private:
  enum Tables { kSlice, kBlocks };
  /// f(rows) for those of slice dz in runs of the blocks `near`.
  template <class F>
  void for_runs(const CubeRows& cube, std::int32_t dz, std::uint64_t near, const F& f) const {
    if (!here_ || dz > cube.reach() || dz < -cube.reach()) return;
    while (near != 0) {
      const std::int32_t from = std::countr_zero(near), to = from + std::countr_one(near >> from);
      near = to < 64 ? near >> to << to : 0;
      const CubeRows::Stretch run = cube.rows(dz, CubeRows::kEdge * ((from << shared_bits_) - most_blocks_),
                                              CubeRows::kEdge * ((to << shared_bits_) - most_blocks_));
      if (run.begin < run.end) f(run);
    }
  }
  [[nodiscard]] bool meet(const CubeRow& row, std::int32_t dy, const Word* mask, const Word* open, Word* met) const;
  /// Words of a table that are not all 0: columns and rows.
  struct Extent {
    std::int32_t first_column = 0, last_column = 0, first_row = 0, last_row = 0;  ///< the last ones are not in it
    [[nodiscard]] bool empty() const { return first_column >= last_column; }
    void add(const Extent& other);
  };
  /// f(first word, count) for the columns of an extent.
  template <class F>
  void for_columns(const Extent& e, const F& f) const {
    for (std::int32_t c = e.first_column; c < e.last_column; ++c)
      f(std::size_t(c) * std::size_t(height_) + std::size_t(e.first_row), std::size_t(e.last_row - e.first_row));
  }
  void load_slice(const BitBox& solid, std::int32_t z);
  void join(const Extent& now);
  /// Level k of tables: x to x + 2^k - 1 together; by columns, y fastest.
  [[nodiscard]] std::size_t level(Tables of, std::int32_t k) const {
    return std::size_t(of * levels_ + k) * level_words();
  }
  void double_along(Tables of, const Extent& now);
  [[nodiscard]] std::size_t level_words() const { return std::size_t(columns_) * std::size_t(height_); }
  [[nodiscard]] Asker asker(Tables of) const;

  VoxelBox region_;
  std::int32_t pad_ = 0;      ///< columns of kAcross voxels left and right of the region
  std::int32_t first_y_ = 0;  ///< of the tables
  std::int32_t columns_ = 0, height_ = 0, levels_ = 0;
  std::int32_t most_blocks_ = 0, shared_bits_ = 0;  ///< bit of blocks i in near(): (i + most_blocks_) >> shared_bits_
  std::vector<Windows> windows_;                    ///< for each length
  std::vector<std::int32_t> columns_of_;            ///< where the column of a start begins, from -reach on
  std::int32_t reach_ = 0;
  std::vector<Word> tables_;  ///< by Tables, then level
  Extent full_[2];            ///< of their finest levels
  std::vector<Word> slices_;  ///< slice z is number z modulo 4
  Extent held_[kSlices];      ///< of each
  std::vector<Word> joined_;  ///< the slices together
  std::int32_t next_ = 0;     ///< slice that is not in them yet
  bool loaded_ = false;
  bool here_ = false;   ///< the slice itself holds something
  std::size_t at_ = 0;  ///< of who asks, in the finest table
};

}  // namespace bp::detail
