#include "lib/closing/detail/row_tables.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "lib/core/clones.h"

namespace bp::detail {

namespace {

using Word = RowTables::Word;
constexpr std::int32_t kAcross = RowTables::kAcross;

/// Sets to[i] to from[i] ORed with the voxels `shift` further on, the rest of which is in the next column. shift <
/// kAcross.
BP_CLONES void widen(const Word* from, const Word* next, std::int32_t shift, std::size_t n, Word* to) {
  for (std::size_t i = 0; i < n; ++i) to[i] = from[i] | from[i] >> shift | next[i] << (kAcross - shift);
}
BP_CLONES void unite(const Word* a, const Word* b, std::size_t n, Word* to) {
  for (std::size_t i = 0; i < n; ++i) to[i] = a[i] | b[i];
}

/// Sets to[i] to words i of kSlices slices, ORed. The slices have `slice` words each and lie one after the other.
BP_CLONES void join_slices(const Word* slices, std::size_t slice, std::size_t n, Word* to) {
  for (std::size_t i = 0; i < n; ++i) {
    Word any = 0;
    for (std::size_t k = 0; k < std::size_t(RowTables::kSlices); ++k) any |= slices[k * slice + i];
    to[i] = any;
  }
}

/// Sets to[i] to words i to i + kEdge - 1, ORed.
BP_CLONES void join_rows(const Word* from, std::size_t n, Word* to) {
  for (std::size_t i = 0; i < n; ++i) {
    Word any = 0;
    for (std::size_t k = 0; k < std::size_t(CubeRows::kEdge); ++k) any |= from[i + k];
    to[i] = any;
  }
}

/// The types hold kAcross words, one for each row, as vectors of GCC and Clang: a plain loop is not always compiled to
/// vector instructions. kVector is their size in bytes.
constexpr std::size_t kVector = sizeof(Word) * kAcross;
typedef Word Words __attribute__((vector_size(kVector)));
typedef std::uint64_t LongWords __attribute__((vector_size(kVector)));

/// Words lie at any multiple of their size. A reference to a vector type of less alignment would be shorter, and Clang
/// takes it for aligned.
BP_INLINE void load(const Word* from, Words& to) {
  std::memcpy(&to, from, kVector);
}
BP_INLINE void store(const Words& from, Word* to) {
  std::memcpy(to, &from, kVector);
}
/// Sets `to` to what both have.
BP_INLINE void load_both(const Word* a, const Word* b, Words& to) {
  Words other;
  load(a, to);
  load(b, other);
  to &= other;
}

BP_INLINE bool any(const Words& words) {
  LongWords w = (LongWords)words;
  w |= __builtin_shufflevector(w, w, 4, 5, 6, 7, 0, 1, 2, 3);
  w |= __builtin_shufflevector(w, w, 2, 3, 0, 1, 6, 7, 4, 5);
  return (w[0] | w[1]) != 0;
}

}  // namespace

/// The place of the voxels that ask: their words are looked up relative to it.
struct RowTables::Asker {
  const Word* here;
  const Windows* of_length;
  const std::int32_t* of_start;  ///< offset of the column by the start of a window; [0] is start 0
};

RowTables::Asker RowTables::asker(Tables of) const {
  return {tables_.data() + level(of, 0) + at_, windows_.data(), columns_of_.data() + reach_};
}

namespace {

/// Ors into `sum` what the window from `start` on holds.
template <class Asker>
BP_INLINE void add_window(const Asker& a, const Word* table, std::int32_t start, Words& sum) {
  Words words;
  load(table + a.of_start[start], words);
  sum |= words >> (start & (kAcross - 1));
}

/// Ors into `sum` the voxels that meet row dy.
template <class Asker>
BP_INLINE void add_row(const Asker& a, const CubeRow& row, std::int32_t dy, Words& sum) {
  const std::int32_t length = row.last - row.first + 1;
  if (length <= 0) return;
  const auto [begin, voxels] = a.of_length[length];
  const Word* table = a.here + (begin + dy);
  add_window(a, table, row.first, sum);
  add_window(a, table, row.last + 1 - voxels, sum);
}

/// Returns a bit for each of n blocks that meets one of the `open` voxels of the mask. The first has bit `first`;
/// 2^shared blocks share a bit.
BP_WIDE_CLONES std::uint64_t find_blocks(const RowTables::Asker& at, const CubeRow* blocks, std::int32_t n,
                                         std::int32_t dy, const Word* mask, const Word* open, std::int32_t first,
                                         std::int32_t shared) {
  Words asking;
  load_both(mask, open, asking);
  if (!any(asking)) return 0;
  std::uint64_t bits = 0;
  for (std::int32_t k = 0; k < n; ++k) {
    Words met = {};
    add_row(at, blocks[k], dy + k * CubeRows::kEdge, met);
    bits |= std::uint64_t(any(met & asking)) << ((first + k) >> shared);
  }
  return bits;
}

/// Takes from `open`, within the mask, the voxels that meet one of n rows from dy on. Returns false if none does.
BP_WIDE_CLONES bool ask_rows(const RowTables::Asker& at, const CubeRow* rows, std::int32_t n, std::int32_t dy,
                             const Word* mask, Word* open) {
  Words met = {}, asking;
  for (std::int32_t i = 0; i < n; ++i) add_row(at, rows[i], dy + i, met);
  load_both(mask, open, asking);
  met &= asking;
  if (!any(met)) return false;
  Words left;
  load(open, left);
  store(left ^ met, open);
  return true;
}

/// Sets `met` to the voxels of `open`, within the mask, that meet the row. Returns false if none does.
BP_WIDE_CLONES bool meet_row(const RowTables::Asker& at, const CubeRow& row, std::int32_t dy, const Word* mask,
                             const Word* open, Word* met) {
  Words sum = {}, asking;
  add_row(at, row, dy, sum);
  load_both(mask, open, asking);
  sum &= asking;
  store(sum, met);
  return any(sum);
}

}  // namespace

void RowTables::lay(const VoxelBox& region, std::int32_t reach) {
  region_ = region;
  pad_ = ceil_div(reach, kAcross) + 1;
  levels_ = std::int32_t(std::bit_width(std::uint32_t(2 * reach + 1)));
  first_y_ = floor_div(region.min.y, kAcross) * kAcross - ceil_div(reach, kAcross) * kAcross;
  height_ = (ceil_div(region.max.y, kAcross) + ceil_div(reach, kAcross)) * kAcross + kAcross - first_y_;
  columns_ = (region.max.x - region.min.x) / kAcross + 2 * pad_;
  reach_ = reach;
  windows_.assign(1, {});
  for (std::int32_t n = 1; n <= 2 * reach + 1; ++n) {
    const int k = std::bit_width(std::uint32_t(n)) - 1;
    windows_.push_back({std::int32_t(level(kSlice, k)), 1 << k});
  }
  columns_of_.clear();
  for (std::int32_t x = -reach; x <= reach; ++x) columns_of_.push_back(floor_div(x, kAcross) * height_);
  most_blocks_ = ceil_div(reach, CubeRows::kEdge);
  for (shared_bits_ = 0; (2 * most_blocks_) >> shared_bits_ >= 64;) ++shared_bits_;
  tables_.assign(2 * level_words() * std::size_t(levels_), 0);
  slices_.assign(level_words() * std::size_t(kSlices), 0);
  joined_.assign(level_words() + std::size_t(CubeRows::kEdge), 0);
  std::fill(std::begin(held_), std::end(held_), Extent{});
  std::fill(std::begin(full_), std::end(full_), Extent{});
  loaded_ = false;
}

void RowTables::Extent::add(const Extent& other) {
  if (other.empty()) return;
  if (empty()) {
    *this = other;
    return;
  }
  first_column = std::min(first_column, other.first_column);
  last_column = std::max(last_column, other.last_column);
  first_row = std::min(first_row, other.first_row);
  last_row = std::max(last_row, other.last_row);
}

void RowTables::load_slice(const BitBox& solid, std::int32_t z) {
  const VoxelBox& box = solid.box();
  Word* to = slices_.data() + std::size_t(z & (kSlices - 1)) * level_words();
  Extent& held = held_[z & (kSlices - 1)];
  for_columns(held, [&](std::size_t first, std::size_t n) { std::fill_n(to + first, n, 0); });
  held = {};
  if (z < box.min.z || z >= box.max.z) return;
  const std::int32_t y0 = std::max(box.min.y, first_y_), y1 = std::min(box.max.y, first_y_ + height_);
  const std::int32_t first = (box.min.x - region_.min.x) / kAcross + pad_;  // column of the solid's first word
  for (std::int32_t y = y0; y < y1; ++y) {
    const std::uint64_t* row = solid.row(y, z);
    for (std::int32_t w = 0; w < solid.words_per_row(); ++w) {
      if (row[w] == 0) continue;
      for (int part = -1; part < 64 / kAcross; ++part) {
        const std::int32_t column = first + w * (64 / kAcross) + part;
        if (column < 0 || column >= columns_) continue;
        to[std::size_t(column) * std::size_t(height_) + std::size_t(y - first_y_)] |=
            Word(part < 0 ? row[w] << kAcross : row[w] >> (kAcross * part));
        held.add({column, column + 1, y - first_y_, y - first_y_ + 1});
      }
    }
  }
}

/// Doubles the windows, level by level. `now` is the extent of the finest level; words of the previous content are
/// overwritten, too.
void RowTables::double_along(Tables of, const Extent& now) {
  const auto h = std::size_t(height_);
  Extent all = full_[of];
  all.add(now);
  full_[of] = now;
  const std::int32_t first = all.first_column;
  for (std::int32_t k = 1; k < levels_; ++k) {
    const std::int32_t shift = 1 << (k - 1);
    const Word* from = tables_.data() + level(of, k - 1);
    Word* to = tables_.data() + level(of, k);
    all.first_column = std::max(first - ceil_div(2 * shift, kAcross), 0);
    for_columns(all, [&](std::size_t word, std::size_t n) {
      // Words beyond the last column are out of every cube's reach.
      const std::size_t step = std::size_t(std::max(shift / kAcross, 1)) * h, last = level_words() - h + word % h;
      const Word *here = from + word, *there = from + std::min(word + step, last);
      if (shift < kAcross) {
        widen(here, there, shift, n, to + word);
      } else {
        unite(here, there, n, to + word);
      }
    });
  }
}

/// Joins 4 slices; `now` is their extent.
void RowTables::join(const Extent& now) {
  constexpr std::int32_t more = CubeRows::kEdge - 1;
  Extent blocks = now, all = full_[kBlocks];
  blocks.first_row = std::max(now.first_row - more, 0);
  all.add(blocks);
  for_columns(all, [&](std::size_t first, std::size_t n) {
    join_slices(slices_.data() + first, level_words(), n, joined_.data() + first);
  });
  for_columns(all, [&](std::size_t first, std::size_t n) {
    join_rows(joined_.data() + first, n, tables_.data() + level(kBlocks, 0) + first);
  });
  double_along(kBlocks, blocks);
}

bool RowTables::load(const BitBox& solid, std::int32_t z) {
  if (!loaded_ || next_ < z || next_ > z + kSlices) next_ = z;
  for (; next_ < z + kSlices; ++next_) load_slice(solid, next_);
  loaded_ = true;
  const Extent& here = held_[z & (kSlices - 1)];
  here_ = !here.empty();
  Extent any;
  for (const Extent& held : held_) any.add(held);
  if (any.empty()) return false;
  join(any);
  if (!here_) return true;
  Extent all = full_[kSlice];
  all.add(here);
  for_columns(all, [&](std::size_t first, std::size_t n) {
    std::copy_n(slices_.data() + std::size_t(z & (kSlices - 1)) * level_words() + first, n, tables_.data() + first);
  });
  double_along(kSlice, here);
  return true;
}

void RowTables::place(std::int32_t x, std::int32_t y) {
  at_ = std::size_t((x - region_.min.x) / kAcross + pad_) * std::size_t(height_) + std::size_t(y - first_y_);
}

std::uint64_t RowTables::near(const CubeRows& cube, std::int32_t dz, const Word* mask, const Word* open) const {
  const CubeRows::Stretch blocks = cube.blocks(dz / CubeRows::kEdge);
  return find_blocks(asker(kBlocks), blocks.rows, blocks.end - blocks.begin, CubeRows::kEdge * blocks.begin, mask, open,
                     blocks.begin + most_blocks_, shared_bits_);
}

bool RowTables::ask(const CubeRows& cube, std::int32_t dz, std::uint64_t near, const Word* mask, Word* open) const {
  bool met = false;
  const Asker at = asker(kSlice);
  for_runs(cube, dz, near, [&](const CubeRows::Stretch& run) {
    met |= ask_rows(at, run.rows, run.end - run.begin, run.begin, mask, open);
  });
  return met;
}

bool RowTables::meet(const CubeRow& row, std::int32_t dy, const Word* mask, const Word* open, Word* met) const {
  return meet_row(asker(kSlice), row, dy, mask, open, met);
}

}  // namespace bp::detail
