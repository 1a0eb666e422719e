#pragma once
#include <bit>
#include <vector>

#include "lib/closing/detail/oriented_cube.h"
#include "lib/grid/bit_box.h"

/// One slice of a box of voxels, made ready for the question: where does a row of voxels, moved along with 64 x 8
/// voxels at once, meet something? And the same for blocks of 8 x 8 rows, from 8 slices on. A row is two windows, each
/// a power of two wide, and each window is read from two words.
namespace bp::detail {

class RowTables {
 public:
  static constexpr std::int32_t kRows = CubeRows::kEdge;

  /// Lays tables for questions from voxels of `region` by cubes of this reach.
  void lay(const VoxelBox& region, std::int32_t reach);

  /// Loads slice z of `solid`, and the 7 behind it. False if nothing of them is in reach.
  bool load(const BitBox& solid, std::int32_t z);
  /// 64 x kRows voxels from (x, y) on ask from now on. x: of whole words.
  void place(std::int32_t x, std::int32_t y);
  /// The blocks from slice dz on, a multiple of 8, in which some of the `left` voxels may meet something. For ask().
  [[nodiscard]] std::uint64_t near(const CubeRows& cube, std::int32_t dz, const std::uint64_t* left) const;
  /// Takes from left[i] the voxels of row y + i that slice dz of the cube, in the blocks `near`, meets something from.
  void ask(const CubeRows& cube, std::int32_t dz, std::uint64_t near, std::uint64_t* left) const;
  /// The same, row by row: take(dy, row, met) for each row that some of `left` meet something of; it may change them.
  template <class Take>
  void ask_each(const CubeRows& cube, std::int32_t dz, std::uint64_t near, const std::uint64_t* left,
                const Take& take) const {
    for_runs(cube, dz, near, [&](const CubeRows::Stretch& run) {
      for (std::int32_t dy = run.begin; dy < run.end; ++dy) {
        std::uint64_t met[kRows];
        if (meet(run.rows[dy - run.begin], dy, left, met)) take(dy, run.rows[dy - run.begin], met);
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
      const CubeRows::Stretch run = cube.rows(dz, kRows * ((from << shared_bits_) - most_blocks_),
                                              kRows * ((to << shared_bits_) - most_blocks_));
      if (run.begin < run.end) f(run);
    }
  }
  [[nodiscard]] bool meet(const CubeRow& row, std::int32_t dy, const std::uint64_t* left, std::uint64_t* met) const;
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
