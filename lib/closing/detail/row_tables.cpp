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

/// sum |= what the window meets from each row.
BP_INLINE void add_window(const RowTables::Window& w, const std::uint64_t* at, Words& sum) {
  const WordsInMemory* a = reinterpret_cast<const WordsInMemory*>(at + w.word[0]);
  const WordsInMemory* b = reinterpret_cast<const WordsInMemory*>(at + w.word[1]);
  const WordsInMemory* c = reinterpret_cast<const WordsInMemory*>(at + w.word[2]);
  const WordsInMemory* d = reinterpret_cast<const WordsInMemory*>(at + w.word[3]);
  sum |= *a >> w.down[0] | *b << w.up[0] | *c >> w.down[1] | *d << w.up[1];
}

/// Flags of the windows, number `first` of the bits and on, that meet something from one of the voxels `left`; 2^shared
/// windows share a bit.
BP_WIDE_CLONES std::uint64_t find_windows(const RowTables::Window* windows, std::int32_t n, const std::uint64_t* at,
                                          const std::uint64_t* left, std::int32_t first, std::int32_t shared) {
  const Words open = *reinterpret_cast<const WordsInMemory*>(left);
  std::uint64_t bits = 0;
  for (std::int32_t k = 0; k < n; ++k) {
    Words met = {};
    add_window(windows[k], at, met);
    met &= open;
    bits |= std::uint64_t(any(met)) << ((first + k) >> shared);
  }
  return bits;
}

/// Takes from `left` what meets something of the windows.
BP_WIDE_CLONES void ask_windows(const RowTables::Window* first, const RowTables::Window* last, const std::uint64_t* at,
                                std::uint64_t* left) {
  Words met = {};
  for (const RowTables::Window* w = first; w < last; ++w) add_window(*w, at, met);
  *reinterpret_cast<WordsInMemory*>(left) &= ~met;
}

}  // namespace

void RowTables::lay(const VoxelBox& region, std::int32_t reach, std::int32_t longest) {
  region_ = region;
  pad_ = ceil_div(reach, 64) + 1;
  levels_ = std::int32_t(std::bit_width(std::uint32_t(std::max(longest, 1))));
  first_y_ = floor_div(region.min.y - reach, kRows) * kRows - kRows;
  height_ = ceil_div(region.max.y + kRows + reach, kRows) * kRows + kRows - first_y_;
  columns_ = (region.max.x - region.min.x) / 64 + 2 * pad_ + 1;
  most_blocks_ = ceil_div(reach, kRows);
  for (shared_bits_ = 0; (2 * most_blocks_) >> shared_bits_ >= 64;) ++shared_bits_;
  tables_.assign(2 * level_words() * std::size_t(levels_));
  slices_.assign(level_words() * std::size_t(kRows));
  loaded_ = false;
}

/// Of the voxels [first, last] of row dy, or of a block that begins there.
RowTables::Window RowTables::window(std::int32_t first, std::int32_t last, std::int32_t dy, Tables of) const {
  Window w;
  const int k = std::bit_width(std::uint32_t(last - first + 1)) - 1;
  const std::int32_t starts[2] = {first, last - (1 << k) + 1};
  for (int i = 0; i < 2; ++i) {
    const std::int32_t column = floor_div(starts[i], 64), shift = starts[i] - 64 * column;
    const auto base = std::int32_t(level(of, k)) + dy;
    w.word[2 * i] = base + column * height_;
    w.word[2 * i + 1] = shift == 0 ? w.word[2 * i] : w.word[2 * i] + height_;
    w.down[i] = std::uint8_t(shift);
    w.up[i] = std::uint8_t(shift == 0 ? 0 : 64 - shift);
  }
  return w;
}

RowTables::Element RowTables::prepare(CubeRows rows) const {
  Element e{std::move(rows), {}, {}, {}, {}, 0, 0, 0};
  e.most_dz = e.rows.reach();
  const CubeRow *first = e.rows.begin(-e.most_dz), *last = e.rows.begin(e.most_dz + 1);
  e.windows.reserve(std::size_t(last - first));
  for (const CubeRow* row = first; row < last; ++row)
    e.windows.push_back(window(row->first, row->last, row->dy, kSlice));
  add_blocks(e);
  return e;
}

void RowTables::add_blocks(Element& e) const {
  e.first = floor_div(-e.most_dz, kRows);
  e.across = floor_div(e.most_dz, kRows) + 1 - e.first;
  struct Hull {
    std::int32_t first = std::int32_t(1) << 30, last = -first;
    [[nodiscard]] bool empty() const { return first > last; }
    void add(const Hull& h) { first = std::min(first, h.first), last = std::max(last, h.last); }
  };
  std::vector<Hull> blocks(std::size_t(e.across) * std::size_t(e.across));
  const CubeRow* all = e.rows.begin(-e.most_dz);
  for (std::int32_t dz = -e.most_dz; dz <= e.most_dz; ++dz) {
    const CubeRow* row = e.rows.begin(dz);
    Hull* block = &blocks[std::size_t(floor_div(dz, kRows) - e.first) * std::size_t(e.across)];
    for (std::int32_t i = e.first; i < e.first + e.across; ++i, ++block) {
      e.starts.push_back(std::uint32_t(row - all));
      for (; row < e.rows.begin(dz + 1) && row->dy < kRows * (i + 1); ++row) block->add({row->first, row->last});
    }
  }
  e.starts.push_back(std::uint32_t(e.windows.size()));
  for (std::size_t j = 0; j < std::size_t(e.across); ++j) {
    const Hull* hulls = blocks.data() + j * std::size_t(e.across);
    std::int32_t first = 0, end = e.across;
    while (first < end && hulls[first].empty()) ++first;
    while (first < end && hulls[end - 1].empty()) --end;
    e.layers.push_back({e.first + first, end - first, e.blocks.size()});
    for (std::int32_t i = first; i < end; ++i) {  // one without rows between others stands for a voxel
      const Hull hull = hulls[i].empty() ? Hull{0, 0} : hulls[i];
      e.blocks.push_back(window(hull.first, hull.last, kRows * (e.first + i), kBlocks));
    }
  }
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

std::uint64_t RowTables::near(const Element& e, std::int32_t dz, const std::uint64_t* left) const {
  const Layer& layer = e.layers[std::size_t(dz / kRows - e.first)];
  return find_windows(e.blocks.data() + layer.block, layer.count, tables_.data() + at_, left,
                      layer.first + most_blocks_, shared_bits_);
}

void RowTables::ask(const Element& e, std::int32_t dz, std::uint64_t near, std::uint64_t* left) const {
  if (!here_ || std::abs(dz) > e.most_dz) return;
  const std::uint32_t* starts = e.starts.data() + std::size_t(dz + e.most_dz) * std::size_t(e.across);
  while (near != 0) {  // run by run
    const std::int32_t from = std::countr_zero(near), to = from + std::countr_one(near >> from);
    near = to < 64 ? near >> to << to : 0;
    const std::int32_t first = std::max((from << shared_bits_) - most_blocks_ - e.first, 0),
                       last = std::min((to << shared_bits_) - most_blocks_ - e.first, e.across);
    if (first < last)
      ask_windows(e.windows.data() + starts[first], e.windows.data() + starts[last], tables_.data() + at_, left);
  }
}

}  // namespace bp::detail
