#pragma once
#include <bit>
#include <vector>

#include "lib/closing/detail/oriented_cube.h"
#include "lib/grid/bit_box.h"

/// One slice of a box of voxels, made ready for one query: 16 x 16 voxels each place the same row of voxels next to
/// themselves; for which of them does the row hold a voxel of the slice? 4 slices together answer the same for blocks
/// of 4 x 4 rows. A row is the union of two windows, each a power of two wide. The tables have 32 voxels from every
/// 16th voxel on, so that a window is read from one word for each of the 16 rows.
namespace bp::detail {

class RowTables {
 public:
  static constexpr std::int32_t kAcross = 16;  ///< voxels that ask together: so many in a row, and so many rows
  static constexpr std::int32_t kSlices = CubeRows::kEdge;  ///< slices that are joined
  /// For rows of some length: where the tables begin of the widest windows that fit in, and the windows' width in
  /// voxels.
  struct Windows {
    std::int32_t begin, voxels;
  };
  struct Asker;
  using Word = std::uint32_t;  ///< voxels that ask use the lower half

  /// Makes room for queries from voxels of `region` by cubes of this reach.
  void lay(const VoxelBox& region, std::int32_t reach);

  /// Loads slice z of `solid` and the 3 slices behind it. Returns false if nothing of them is in reach.
  bool load(const BitBox& solid, std::int32_t z);
  /// Makes the kAcross x kAcross voxels from (x, y) on those that ask. x and y: multiples of kAcross.
  void place(std::int32_t x, std::int32_t y);
  /// Returns the blocks from slice dz on, a multiple of 4, in which some `open` voxels of the `mask` may meet a voxel
  /// of the solid. ask() needs them.
  [[nodiscard]] std::uint64_t near(const CubeRows& cube, std::int32_t dz, const Word* mask, const Word* open) const;
  /// Takes from open[i], within the `mask`, the voxels of row y + i from which slice dz of the cube, in the blocks
  /// `near`, meets a voxel of the solid. Returns false if there are none.
  bool ask(const CubeRows& cube, std::int32_t dz, std::uint64_t near, const Word* mask, Word* open) const;
  /// Does the same row by row: calls take(dy, row, met) for each row that some voxels meet. take() may change `open`.
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
  /// Calls f(rows) for the rows of slice dz in runs of the blocks `near`.
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
  /// The columns and rows of a table outside of which all words are 0.
  struct Extent {
    std::int32_t first_column = 0, last_column = 0, first_row = 0, last_row = 0;  ///< the last ones do not belong to it
    [[nodiscard]] bool empty() const { return first_column >= last_column; }
    void add(const Extent& other);
  };
  /// Calls f(first word, count) for the columns of an extent.
  template <class F>
  void for_columns(const Extent& e, const F& f) const {
    for (std::int32_t c = e.first_column; c < e.last_column; ++c)
      f(std::size_t(c) * std::size_t(height_) + std::size_t(e.first_row), std::size_t(e.last_row - e.first_row));
  }
  void load_slice(const BitBox& solid, std::int32_t z);
  void join(const Extent& now);
  /// Returns where level k of tables begins. Its words stand for x to x + 2^k - 1, ORed; they lie by columns, y
  /// fastest.
  [[nodiscard]] std::size_t level(Tables of, std::int32_t k) const {
    return std::size_t(of * levels_ + k) * level_words();
  }
  void double_along(Tables of, const Extent& now);
  [[nodiscard]] std::size_t level_words() const { return std::size_t(columns_) * std::size_t(height_); }
  [[nodiscard]] Asker asker(Tables of) const;

  VoxelBox region_;
  std::int32_t pad_ = 0;      ///< columns of kAcross voxels left and right of the region
  std::int32_t first_y_ = 0;  ///< first row of the tables
  std::int32_t columns_ = 0, height_ = 0, levels_ = 0;
  std::int32_t most_blocks_ = 0, shared_bits_ = 0;  ///< bit of blocks i in near(): (i + most_blocks_) >> shared_bits_
  std::vector<Windows> windows_;                    ///< by the length of a row
  std::vector<std::int32_t> columns_of_;            ///< where the column of a start begins; starts from -reach on
  std::int32_t reach_ = 0;
  std::vector<Word> tables_;  ///< by Tables, then level
  Extent full_[2];            ///< of the finest level of each
  std::vector<Word> slices_;  ///< four slices; slice z is number z modulo 4
  Extent held_[kSlices];      ///< of each slice
  std::vector<Word> joined_;  ///< the slices together
  std::int32_t next_ = 0;     ///< the next slice to be joined
  bool loaded_ = false;
  bool here_ = false;   ///< the slice itself holds something
  std::size_t at_ = 0;  ///< of the voxels that ask, in the finest table
};

}  // namespace bp::detail
