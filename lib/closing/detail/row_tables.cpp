#include "lib/closing/detail/row_tables.h"

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

/// to[i] |= from[i] & mask
BP_INLINE void gather(const std::uint64_t* from, std::uint64_t mask, std::size_t n, std::uint64_t* to) {
  for (std::size_t i = 0; i < n; ++i) to[i] |= from[i] & mask;
}

/// sum[i] |= what the window meets from row i.
BP_INLINE void add_window(const RowTables::Window& w, const std::uint64_t* at, std::uint64_t* sum) {
  const std::uint64_t *a = at + w.word[0], *b = at + w.word[1], *c = at + w.word[2], *d = at + w.word[3];
  for (int i = 0; i < RowTables::kRows; ++i)
    sum[i] |= a[i] >> w.down[0] | b[i] << w.up[0] | c[i] >> w.down[1] | d[i] << w.up[1];
}

/// left[i] &= ~met[i]. False if nothing is left that is in `of`.
BP_INLINE bool take(const std::uint64_t* met, const std::uint64_t* of, std::uint64_t* left) {
  std::uint64_t any = 0;
  for (int i = 0; i < RowTables::kRows; ++i) {
    left[i] &= ~met[i];
    any |= left[i] & of[i];
  }
  return any != 0;
}

/// Rows that hold nothing are passed over: rows[w.dy]; and groups where no voxel that is left meets any of the rows.
BP_WIDE_CLONES void ask_groups(const RowTables::Group* first, const RowTables::Group* last,
                               const RowTables::Window* windows, const std::uint64_t* at, const std::uint64_t* rows,
                               std::uint64_t* open) {
  constexpr int n = RowTables::kRows;
  constexpr std::uint64_t nothing[n] = {};
  std::uint64_t left[n];
  for (int i = 0; i < n; ++i) left[i] = open[i];
  for (const RowTables::Group* g = first; g < last; ++g) {
    if ((rows[g->some.dy] | rows[g->some.dy + g->count - 1]) == 0) continue;
    std::uint64_t some[n] = {};
    add_window(g->some, at, some);
    if (!take(nothing, some, left)) continue;
    if (g->shares) {
      std::uint64_t all[n] = {};
      add_window(g->all, at, all);
      if (!take(all, some, left)) continue;
    }
    std::uint64_t met[n] = {};
    for (const RowTables::Window *w = windows + g->first, *end = w + g->count; w < end; ++w) {
      if (rows[w->dy] != 0) add_window(*w, at, met);
    }
    take(met, some, left);
  }
  for (int i = 0; i < n; ++i) open[i] = left[i];
}

/// rows[i] := what rows i to i + kRows - 1 hold of the words [first, last] of `columns`, cut to two masks.
BP_WIDE_CLONES bool held_rows(const std::uint64_t* column, std::size_t stride, std::int32_t count, std::uint64_t first,
                              std::uint64_t last, std::size_t n, std::uint64_t* rows) {
  for (std::size_t i = 0; i < n; ++i) rows[i] = 0;
  for (std::int32_t k = 0; k < count; ++k) {
    std::uint64_t mask = ~std::uint64_t(0);
    if (k == 0) mask &= first;
    if (k == count - 1) mask &= last;
    gather(column + std::size_t(k) * stride, mask, n, rows);
  }
  std::uint64_t any = 0;
  for (std::size_t i = 0; i < n; ++i) any |= rows[i];
  if (any == 0) return false;
  for (const std::size_t step : {1, 2, 4}) {
    for (std::size_t i = 0; i + step < n; ++i) rows[i] |= rows[i + step];
  }
  return true;
}

}  // namespace

void RowTables::lay(const VoxelBox& region, std::int32_t reach, std::int32_t longest) {
  region_ = region;
  pad_ = ceil_div(reach, 64) + 1;
  levels_ = std::int32_t(std::bit_width(std::uint32_t(std::max(longest, 1))));
  first_y_ = floor_div(region.min.y, kRows) * kRows - reach;
  height_ = ceil_div(region.max.y, kRows) * kRows + reach - first_y_;
  columns_ = (region.max.x - region.min.x) / 64 + 2 * pad_ + 1;
  tables_.assign(level_words() * std::size_t(levels_), 0);
}

/// Of the voxels [first, last] of row dy; `wide`: of kRows rows from there on.
RowTables::Window RowTables::window(std::int32_t first, std::int32_t last, std::int32_t dy, bool wide) const {
  Window w{};
  w.dy = dy;
  const int level = std::bit_width(std::uint32_t(last - first + 1)) - 1;
  const std::int32_t starts[2] = {first, last - (1 << level) + 1};
  for (int i = 0; i < 2; ++i) {
    const std::int32_t column = floor_div(starts[i], 64), shift = starts[i] - 64 * column;
    const auto base = std::int32_t((level + (wide ? levels_ : 0)) * std::int32_t(level_words())) + dy;
    w.word[2 * i] = base + column * height_;
    w.word[2 * i + 1] = shift == 0 ? w.word[2 * i] : w.word[2 * i] + height_;
    w.down[i] = std::uint8_t(shift);
    w.up[i] = std::uint8_t(shift == 0 ? 0 : 64 - shift);
  }
  return w;
}

RowTables::Element RowTables::prepare(CubeRows rows) const {
  Element e{std::move(rows), {}, {}, {}, 0};
  e.most_dz = e.rows.reach();
  const CubeRow *first = e.rows.begin(-e.most_dz), *last = e.rows.begin(e.most_dz + 1);
  e.windows.reserve(std::size_t(last - first));
  for (const CubeRow* row = first; row < last; ++row)
    e.windows.push_back(window(row->first, row->last, row->dy, false));
  add_groups(e);
  return e;
}

void RowTables::add_groups(Element& e) const {
  const CubeRow* all = e.rows.begin(-e.most_dz);
  for (std::int32_t dz = -e.most_dz; dz <= e.most_dz; ++dz) {
    e.slices.push_back(std::uint32_t(e.groups.size()));
    for (const CubeRow *row = e.rows.begin(dz), *end = e.rows.begin(dz + 1), *next; row < end; row = next) {
      std::int32_t low = row->first, high = row->last, from = low, to = high;  // of any, and of all
      for (next = row + 1; next < end && next->dy < row->dy + kRows; ++next) {
        low = std::min(low, next->first), high = std::max(high, next->last);
        from = std::max(from, next->first), to = std::min(to, next->last);
      }
      const auto count = std::int32_t(next - row);
      const bool shares = count == kRows && from <= to;
      e.groups.push_back({(next - 1)->dy - row->dy + 1, std::uint32_t(row - all), window(low, high, row->dy, true),
                          shares ? window(from, to, row->dy, true) : Window{}, shares});
    }
  }
  e.slices.push_back(std::uint32_t(e.groups.size()));
}

bool RowTables::load(const BitBox& solid, std::int32_t z) {
  const VoxelBox& box = solid.box();
  if (z < box.min.z || z >= box.max.z) return false;
  const std::int32_t y0 = std::max(box.min.y, first_y_), y1 = std::min(box.max.y, first_y_ + height_);
  const std::int32_t left = region_.min.x - 64 * pad_;
  std::fill_n(tables_.begin(), level_words(), 0);
  const std::int32_t c0 = std::max(0, (box.min.x - left) / 64), c1 = std::min(columns_, (box.max.x - left) / 64);
  bool any = false;
  for (std::int32_t y = y0; y < y1; ++y) {
    const std::uint64_t* row = solid.row(y, z) - (box.min.x - left) / 64;
    for (std::int32_t c = c0; c < c1; ++c) {
      if (row[c] == 0) continue;
      tables_[std::size_t(c) * std::size_t(height_) + std::size_t(y - first_y_)] = row[c];
      any = true;
    }
  }
  if (!any) return false;
  const auto h = std::size_t(height_);
  for (std::int32_t k = 1; k < levels_; ++k) {
    const std::int32_t shift = 1 << (k - 1);
    const std::uint64_t* from = tables_.data() + std::size_t(k - 1) * level_words();
    std::uint64_t* to = tables_.data() + std::size_t(k) * level_words();
    for (std::int32_t c = 0; c < columns_; ++c) {
      // What lies beyond the last column is out of every element's reach.
      const std::int32_t near = std::min(c + shift / 64, columns_ - 1), far = std::min(near + 1, columns_ - 1);
      widen(from + std::size_t(c) * h, from + std::size_t(near) * h, from + std::size_t(far) * h, shift % 64, h,
            to + std::size_t(c) * h);
    }
  }
  return true;
}

bool RowTables::look(const Asking& asking) {
  asking_ = asking;
  const std::int32_t from = asking.first - asking.reach, to = asking.last + asking.reach;
  const std::int32_t column = (asking.x - region_.min.x) / 64 + pad_, c0 = column + floor_div(from, 64),
                     c1 = column + floor_div(to, 64);
  const auto at = std::size_t(asking.y - first_y_ - asking.reach), n = std::size_t(2 * asking.reach + kRows);
  held_.resize(std::max(held_.size(), n));
  return held_rows(tables_.data() + std::size_t(c0) * std::size_t(height_) + at, std::size_t(height_), c1 - c0 + 1,
                   ~std::uint64_t(0) << (from & 63), ~std::uint64_t(0) >> (63 - (to & 63)), n, held_.data());
}

void RowTables::ask(const Element& e, std::int32_t dz, std::uint64_t* acc) const {
  const CubeRow* all = e.rows.begin(-e.most_dz);
  const Window *first = e.windows.data() + (e.rows.begin(dz) - all),
               *last = e.windows.data() + (e.rows.begin(dz + 1) - all);
  const std::int32_t column = (asking_.x - region_.min.x) / 64 + pad_;
  const std::size_t here = std::size_t(column) * std::size_t(height_) + std::size_t(asking_.y - first_y_);
  or_windows(first, last, tables_.data() + here, held_.data() + asking_.reach, acc);
}

}  // namespace bp::detail
