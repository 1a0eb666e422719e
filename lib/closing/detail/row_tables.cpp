#include "lib/closing/detail/row_tables.h"

#include <bit>
#include <limits>

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

BP_WIDE_CLONES void or_windows(const RowTables::Window* first, const RowTables::Window* last, const std::uint64_t* at,
                               std::uint64_t* acc) {
  std::uint64_t sum[RowTables::kRows];
  for (int i = 0; i < RowTables::kRows; ++i) sum[i] = acc[i];
  for (const RowTables::Window* w = first; w < last; ++w) {
    const std::uint64_t *a = at + w->word[0], *b = at + w->word[1], *c = at + w->word[2], *d = at + w->word[3];
    for (int i = 0; i < RowTables::kRows; ++i)
      sum[i] |= a[i] >> w->down[0] | b[i] << w->up[0] | c[i] >> w->down[1] | d[i] << w->up[1];
  }
  for (int i = 0; i < RowTables::kRows; ++i) acc[i] = sum[i];
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
  occupied_.resize(std::size_t(columns_));
}

RowTables::Element RowTables::prepare(CubeRows rows) const {
  Element e{std::move(rows), {}, 0};
  e.most_dz = e.rows.reach();
  for (const CubeRow* row = e.rows.begin(-e.most_dz); row < e.rows.begin(e.most_dz + 1); ++row) {
    Window w{};
    w.dy = row->dy;
    const int level = std::bit_width(std::uint32_t(row->last - row->first + 1)) - 1;
    const std::int32_t starts[2] = {row->first, row->last - (1 << level) + 1};
    for (int i = 0; i < 2; ++i) {
      const std::int32_t column = floor_div(starts[i], 64), shift = starts[i] - 64 * column;
      const auto base = std::int32_t(level * std::int32_t(level_words())) + row->dy;
      w.word[2 * i] = base + column * height_;
      w.word[2 * i + 1] = shift == 0 ? w.word[2 * i] : w.word[2 * i] + height_;
      w.down[i] = std::uint8_t(shift);
      w.up[i] = std::uint8_t(shift == 0 ? 0 : 64 - shift);
    }
    e.windows.push_back(w);
  }
  return e;
}

bool RowTables::load(const BitBox& solid, std::int32_t z) {
  const VoxelBox& box = solid.box();
  if (z < box.min.z || z >= box.max.z) return false;
  const std::int32_t y0 = std::max(box.min.y, first_y_), y1 = std::min(box.max.y, first_y_ + height_);
  const std::int32_t left = region_.min.x - 64 * pad_;
  constexpr Span kNone{std::numeric_limits<std::int32_t>::max(), std::numeric_limits<std::int32_t>::min()};
  std::vector<Span> own(std::size_t(columns_), kNone);
  std::fill_n(tables_.begin(), level_words(), 0);
  const std::int32_t c0 = std::max(0, (box.min.x - left) / 64), c1 = std::min(columns_, (box.max.x - left) / 64);
  bool any = false;
  for (std::int32_t y = y0; y < y1; ++y) {
    const std::uint64_t* row = solid.row(y, z) - (box.min.x - left) / 64;
    for (std::int32_t c = c0; c < c1; ++c) {
      if (row[c] == 0) continue;
      tables_[std::size_t(c) * std::size_t(height_) + std::size_t(y - first_y_)] = row[c];
      Span& span = own[std::size_t(c)];
      span = {std::min(span.min, y), std::max(span.max, y)};
      any = true;
    }
  }
  if (!any) return false;
  for (std::int32_t c = 0; c < columns_; ++c) {
    Span span = kNone;
    for (std::int32_t d = std::max(0, c - pad_); d <= std::min(columns_ - 1, c + pad_); ++d)
      span = {std::min(span.min, own[std::size_t(d)].min), std::max(span.max, own[std::size_t(d)].max)};
    occupied_[std::size_t(c)] = span;
  }
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

void RowTables::ask(const Element& e, std::int32_t dz, std::int32_t x, std::int32_t y, std::uint64_t* acc) const {
  const std::int32_t column = (x - region_.min.x) / 64 + pad_;
  const Span span = occupied_[std::size_t(column)];
  if (span.min > span.max) return;
  const CubeRow* all = e.rows.begin(-e.most_dz);
  const Window *first = e.windows.data() + (e.rows.begin(dz) - all),
               *last = e.windows.data() + (e.rows.begin(dz + 1) - all);
  while (first < last && first->dy + y + kRows <= span.min) ++first;
  while (first < last && (last - 1)->dy + y > span.max) --last;
  or_windows(first, last, tables_.data() + std::size_t(column) * std::size_t(height_) + std::size_t(y - first_y_), acc);
}

}  // namespace bp::detail
