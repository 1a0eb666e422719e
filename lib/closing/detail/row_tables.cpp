#include "lib/closing/detail/row_tables.h"

#include <algorithm>
#include <bit>

#include "lib/core/clones.h"

namespace bp::detail {

namespace {

/// to[i] = from[i] | voxels `shift` further, of which the next column holds the rest.
BP_CLONES void widen(const std::uint64_t* from, const std::uint64_t* near, const std::uint64_t* far, std::int32_t shift,
                     std::size_t n, std::uint64_t* to) {
  if (shift == 0) {
    for (std::size_t i = 0; i < n; ++i) to[i] = from[i] | near[i];
  } else {
    for (std::size_t i = 0; i < n; ++i) to[i] = from[i] | near[i] >> shift | far[i] << (64 - shift);
  }
}

/// to[i] := words i of `count` slices of n, one after the other.
BP_CLONES void join_slices(const std::uint64_t* slices, std::size_t n, std::uint64_t* to) {
  for (std::size_t i = 0; i < n; ++i) {
    std::uint64_t any = 0;
    for (std::size_t k = 0; k < std::size_t(RowTables::kRows); ++k) any |= slices[k * n + i];
    to[i] = any;
  }
}

/// to[i] := words i to i + kRows - 1 of n; of the last ones, no more than there are.
BP_CLONES void join_rows(const std::uint64_t* from, std::size_t n, std::uint64_t* to) {
  constexpr auto rows = std::size_t(RowTables::kRows);
  std::size_t i = 0;
  for (; i + rows <= n; ++i) {
    std::uint64_t any = 0;
    for (std::size_t k = 0; k < rows; ++k) any |= from[i + k];
    to[i] = any;
  }
  for (; i < n; ++i) {
    to[i] = 0;
    for (std::size_t k = i; k < n; ++k) to[i] |= from[k];
  }
}

/// A word of each of kRows rows. Vectors of GCC and Clang: loops over them are not always made into such.
typedef std::uint64_t Words __attribute__((vector_size(8 * RowTables::kRows)));
typedef std::uint64_t WordsInMemory __attribute__((vector_size(8 * RowTables::kRows), aligned(8), may_alias));

BP_INLINE bool any(const Words& words) {
  Words w = words;
  w |= __builtin_shufflevector(w, w, 4, 5, 6, 7, 0, 1, 2, 3);
  w |= __builtin_shufflevector(w, w, 2, 3, 0, 1, 6, 7, 4, 5);
  return (w[0] | w[1]) != 0;
}

/// Where rows are looked up: level k of the tables begins k `level` words further.
struct Levels {
  const std::uint64_t* first;  ///< of who asks
  std::size_t level, height;   ///< words
};

/// sum |= what 2^k voxels from `start` on hold.
BP_INLINE void add_window(const Levels& at, int k, std::int32_t start, std::int32_t dy, Words& sum) {
  const std::uint64_t* table = at.first + std::size_t(k) * at.level + (start >> 6) * std::ptrdiff_t(at.height) + dy;
  const int down = start & 63, up = -start & 63;
  const WordsInMemory* here = reinterpret_cast<const WordsInMemory*>(table);
  const WordsInMemory* next = reinterpret_cast<const WordsInMemory*>(table + (down != 0 ? at.height : 0));
  sum |= *here >> down | *next << up;
}

/// sum |= what row dy meets.
BP_INLINE void add_row(const Levels& at, const CubeRow& row, std::int32_t dy, Words& sum) {
  const std::int32_t length = row.last - row.first + 1;
  if (length <= 0) return;
  const int k = 31 - __builtin_clz(unsigned(length));
  add_window(at, k, row.first, dy, sum);
  add_window(at, k, row.last + 1 - (1 << k), dy, sum);
}

/// Flags of the n blocks, number `first` of the bits and on, that meet something from one of the voxels `left`;
/// 2^shared blocks share a bit.
BP_WIDE_CLONES std::uint64_t find_blocks(const Levels& at, const CubeRow* blocks, std::int32_t n, std::int32_t dy,
                                         const std::uint64_t* left, std::int32_t first, std::int32_t shared) {
  const Words open = *reinterpret_cast<const WordsInMemory*>(left);
  std::uint64_t bits = 0;
  for (std::int32_t k = 0; k < n; ++k) {
    Words met = {};
    add_row(at, blocks[k], dy + k * RowTables::kRows, met);
    met &= open;
    bits |= std::uint64_t(any(met)) << ((first + k) >> shared);
  }
  return bits;
}

/// Takes from `left` what meets something of n rows from dy on.
BP_WIDE_CLONES void ask_rows(const Levels& at, const CubeRow* rows, std::int32_t n, std::int32_t dy,
                             std::uint64_t* left) {
  Words met = {};
  for (std::int32_t i = 0; i < n; ++i) add_row(at, rows[i], dy + i, met);
  *reinterpret_cast<WordsInMemory*>(left) &= ~met;
}

/// met := those of `left` that meet something of the row. False if there are none.
BP_WIDE_CLONES bool meet_row(const Levels& at, const CubeRow& row, std::int32_t dy, const std::uint64_t* left,
                             std::uint64_t* met) {
  Words sum = {};
  add_row(at, row, dy, sum);
  sum &= *reinterpret_cast<const WordsInMemory*>(left);
  *reinterpret_cast<WordsInMemory*>(met) = sum;
  return any(sum);
}

}  // namespace

void RowTables::lay(const VoxelBox& region, std::int32_t reach) {
  region_ = region;
  pad_ = ceil_div(reach, 64) + 1;
  levels_ = std::int32_t(std::bit_width(std::uint32_t(2 * reach + 1)));
  first_y_ = floor_div(region.min.y - reach, kRows) * kRows - kRows;
  height_ = ceil_div(region.max.y + kRows + reach, kRows) * kRows + kRows - first_y_;
  columns_ = (region.max.x - region.min.x) / 64 + 2 * pad_ + 1;
  most_blocks_ = ceil_div(reach, kRows);
  for (shared_bits_ = 0; (2 * most_blocks_) >> shared_bits_ >= 64;) ++shared_bits_;
  tables_.assign(2 * level_words() * std::size_t(levels_));
  slices_.assign(level_words() * std::size_t(kRows));
  loaded_ = false;
}

bool RowTables::load_slice(const BitBox& solid, std::int32_t z, std::uint64_t* to) const {
  const VoxelBox& box = solid.box();
  std::fill_n(to, level_words(), 0);
  if (z < box.min.z || z >= box.max.z) return false;
  const std::int32_t y0 = std::max(box.min.y, first_y_), y1 = std::min(box.max.y, first_y_ + height_);
  const std::int32_t left = region_.min.x - 64 * pad_;
  const std::int32_t c0 = std::max(0, (box.min.x - left) / 64), c1 = std::min(columns_, (box.max.x - left) / 64);
  bool any = false;
  for (std::int32_t y = y0; y < y1; ++y) {
    const std::uint64_t* row = solid.row(y, z) - (box.min.x - left) / 64;
    for (std::int32_t c = c0; c < c1; ++c) {
      if (row[c] == 0) continue;
      to[std::size_t(c) * std::size_t(height_) + std::size_t(y - first_y_)] = row[c];
      any = true;
    }
  }
  return any;
}

void RowTables::double_along(Tables of) {
  const auto h = std::size_t(height_);
  for (std::int32_t k = 1; k < levels_; ++k) {
    const std::int32_t shift = 1 << (k - 1);
    const std::uint64_t* from = tables_.data() + level(of, k - 1);
    std::uint64_t* to = tables_.data() + level(of, k);
    for (std::int32_t c = 0; c < columns_; ++c) {
      // What lies beyond the last column is out of every element's reach.
      const std::int32_t near = std::min(c + shift / 64, columns_ - 1), far = std::min(near + 1, columns_ - 1);
      widen(from + std::size_t(c) * h, from + std::size_t(near) * h, from + std::size_t(far) * h, shift % 64, h,
            to + std::size_t(c) * h);
    }
  }
}

bool RowTables::load(const BitBox& solid, std::int32_t z) {
  const auto number = [](std::int32_t slice) { return std::size_t(slice & (kRows - 1)); };
  if (!loaded_ || next_ < z || next_ > z + kRows) next_ = z;
  for (; next_ < z + kRows; ++next_)
    held_[number(next_)] = load_slice(solid, next_, slices_.data() + number(next_) * level_words());
  loaded_ = true;
  here_ = held_[number(z)];
  if (std::none_of(held_, held_ + kRows, [](bool held) { return held; })) return false;
  // What 8 slices hold, in the place of the slice's own until it comes itself.
  join_slices(slices_.data(), level_words(), tables_.data());
  join_rows(tables_.data(), level_words(), tables_.data() + level(kBlocks, 0));
  double_along(kBlocks);
  if (!here_) return true;
  std::copy_n(slices_.data() + number(z) * level_words(), level_words(), tables_.data());
  double_along(kSlice);
  return true;
}

void RowTables::place(std::int32_t x, std::int32_t y) {
  at_ = std::size_t((x - region_.min.x) / 64 + pad_) * std::size_t(height_) + std::size_t(y - first_y_);
}

std::uint64_t RowTables::near(const CubeRows& cube, std::int32_t dz, const std::uint64_t* left) const {
  const CubeRows::Stretch blocks = cube.blocks(dz / kRows);
  return find_blocks({tables_.data() + level(kBlocks, 0) + at_, level_words(), std::size_t(height_)}, blocks.rows,
                     blocks.end - blocks.begin, kRows * blocks.begin, left, blocks.begin + most_blocks_, shared_bits_);
}

void RowTables::ask(const CubeRows& cube, std::int32_t dz, std::uint64_t near, std::uint64_t* left) const {
  for_runs(cube, dz, near, [&](const CubeRows::Stretch& run) {
    ask_rows({tables_.data() + at_, level_words(), std::size_t(height_)}, run.rows, run.end - run.begin, run.begin,
             left);
  });
}

bool RowTables::meet(const CubeRow& row, std::int32_t dy, const std::uint64_t* left, std::uint64_t* met) const {
  return meet_row({tables_.data() + at_, level_words(), std::size_t(height_)}, row, dy, left, met);
}

}  // namespace bp::detail
