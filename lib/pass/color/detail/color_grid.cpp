#include "lib/pass/color/detail/color_grid.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <optional>
#include <tuple>
#include <type_traits>

#include "lib/core/parallel.h"

namespace bp {

namespace {

ColorBrick brick_of(ColorCell c) {
  constexpr std::int32_t e = ColorGrid::kEdge;
  return {floor_div(c.x, e), floor_div(c.y, e), floor_div(c.z, e)};
}

constexpr std::uint64_t kLayers = kColorCellVox, kSides = 16, kOfCell = kSides * kLayers;  // numbers in an index
static_assert(kColorSides.size() <= kSides);
constexpr std::uint64_t kFewest = 16;  // of the surface along an axis in a cell: a 16th of it is enough

ColorCell cell_of(ColorBrick brick, std::uint64_t index) {
  constexpr std::int32_t e = ColorGrid::kEdge;
  const auto i = std::int32_t(index / kOfCell);
  return {brick.x * e + i % e, brick.y * e + i / e % e, brick.z * e + i / (e * e)};
}

}  // namespace

ColorGrid::ColorGrid(std::shared_ptr<Scratch> store, std::uint64_t memory_bytes)
    : store_(std::move(store)), memory_bytes_(memory_bytes) {}

ColorGrid::~ColorGrid() {
  for (const auto& [coord, handle] : bricks_) store_->drop(handle);
}

void ColorGrid::merge(std::vector<Entry>& entries) {
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.index < b.index; });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (kept > 0 && entries[kept - 1].index == entries[i].index) {
      entries[kept - 1].sum.add(entries[i].sum);
    } else {
      entries[kept++] = entries[i];
    }
  }
  entries.resize(kept);
}

// The sums are sorted before the lock is taken, so that a brick is looked up once for all its cells.
void ColorGrid::add(std::vector<ColorCellSum>& sums) {
  std::sort(sums.begin(), sums.end(), [](const ColorCellSum& a, const ColorCellSum& b) {
    const ColorBrick p = brick_of(a.cell), q = brick_of(b.cell);
    return p != q ? p < q : std::tie(a.cell, a.side, a.layer) < std::tie(b.cell, b.side, b.layer);
  });
  const std::lock_guard lock(mutex_);
  for (std::size_t i = 0; i < sums.size();) {
    const ColorBrick coord = brick_of(sums[i].cell);
    Brick& brick = gathering_[coord];
    const std::size_t before = brick.entries.capacity();
    while (i < sums.size() && brick_of(sums[i].cell) == coord) {
      ColorCellSum merged = sums[i++];
      const auto is_same = [&](const ColorCellSum& s) {
        return s.cell == merged.cell && s.side == merged.side && s.layer == merged.layer;
      };
      for (; i < sums.size() && is_same(sums[i]); ++i) merged.sum.add(sums[i].sum);
      brick.entries.push_back(
          {index_in(coord, merged.cell) * kOfCell + merged.side * kLayers + merged.layer, merged.sum});
    }
    if (brick.entries.size() > 2 * brick.merged + 256) {
      merge(brick.entries);
      brick.merged = brick.entries.size();
    }
    used_bytes_ += (brick.entries.capacity() - before) * sizeof(Entry);
  }
  sums.clear();
  if (used_bytes_ > memory_bytes_) spill();
}

void ColorGrid::spill() {
  static_assert(std::is_trivially_copyable_v<Entry>);
  for (auto& [coord, brick] : gathering_) {
    if (brick.entries.empty()) continue;
    merge(brick.entries);
    brick.chunks.push_back(store_->put(std::as_bytes(std::span(brick.entries))));
    std::vector<Entry>().swap(brick.entries);
    brick.merged = 0;
  }
  used_bytes_ = 0;
}

std::vector<ColorGrid::Entry> ColorGrid::all_of(const Brick& brick) const {
  std::vector<Entry> entries = brick.entries;
  std::vector<std::byte> bytes;
  for (const Scratch::Handle h : brick.chunks) {
    store_->get(h, bytes);
    const std::size_t old = entries.size();
    entries.resize(old + bytes.size() / sizeof(Entry));
    std::memcpy(static_cast<void*>(entries.data() + old), bytes.data(), bytes.size());
  }
  merge(entries);
  return entries;
}

/// Keeps what is seen of `entries`, which are sorted. The layers of a cell become one: the seen ones; if there are
/// none, those above a seen one; else all.
void ColorGrid::keep_seen(std::vector<Entry>& entries, ColorBrick coord, const Mask& seen) {
  std::size_t kept = 0;
  for (std::size_t i = 0, end = 0; i < entries.size(); i = end) {
    const std::uint64_t side = entries[i].index / kLayers;
    const std::uint32_t mask = seen(cell_of(coord, entries[i].index));
    const std::uint32_t layers = mask >> (kLayers * std::min<std::uint64_t>(side % kSides, kColorAxes));
    std::array<ColorSum, 3> sums;
    for (end = i; end < entries.size() && entries[end].index / kLayers == side; ++end) {
      const std::uint32_t here = layers >> entries[end].index % kLayers;
      if ((here & 1) != 0) sums[0].add(entries[end].sum);
      if ((here & ColorGrid::kAbove) != 0) sums[1].add(entries[end].sum);
      sums[2].add(entries[end].sum);
    }
    std::size_t n = 0;
    while (sums[n].weight * kFewest < sums[2].weight) ++n;
    if (mask != 0) entries[kept++] = {side * kLayers, sums[n]};
  }
  entries.resize(kept);
}

void ColorGrid::finish(const std::function<Mask(ColorBrick)>& seen) {
  struct Done {
    std::optional<Scratch::Handle> chunk;
    std::uint64_t cells = 0;
    bool white = true;
  };
  std::vector<ColorBrick> coords;
  for (const auto& [coord, brick] : gathering_) coords.push_back(coord);
  std::sort(coords.begin(), coords.end());
  std::vector<Done> done(coords.size());
  parallel_for(std::int64_t(coords.size()), [&](std::int64_t i) {
    const ColorBrick coord = coords[std::size_t(i)];
    Brick& brick = gathering_.at(coord);
    std::vector<Entry> entries = all_of(brick);
    for (const Scratch::Handle h : brick.chunks) store_->drop(h);
    std::vector<Entry>().swap(brick.entries);
    keep_seen(entries, coord, seen(coord));
    Done& d = done[std::size_t(i)];
    for (std::size_t k = 0; k < entries.size(); ++k) {
      d.cells += k == 0 || entries[k].index / kOfCell != entries[k - 1].index / kOfCell;
      d.white = d.white && entries[k].sum.mean() == kWhite;
    }
    if (!entries.empty()) d.chunk = store_->put(std::as_bytes(std::span(entries)));
  });
  gathering_.clear();
  for (std::size_t i = 0; i < coords.size(); ++i) {
    if (!done[i].chunk) continue;
    bricks_.emplace_back(coords[i], *done[i].chunk);
    cells_ += done[i].cells;
    all_white_ = all_white_ && done[i].white;
  }
}

void ColorGrid::each_sum(ColorBrick coord, const std::function<void(const ColorCellSum&)>& body) const {
  const auto at = std::lower_bound(bricks_.begin(), bricks_.end(), coord,
                                   [](const auto& brick, ColorBrick c) { return brick.first < c; });
  if (at == bricks_.end() || at->first != coord) return;
  Brick brick;
  brick.chunks = {at->second};
  for (const Entry& e : all_of(brick))
    body({cell_of(coord, e.index), std::uint16_t(e.index / kLayers % kSides), 0, e.sum});
}

std::vector<CellColor> ColorGrid::load(ColorCell min, ColorCell max) const {
  std::vector<CellColor> cells;
  const auto inside = [&](ColorCell c) {
    for (int i = 0; i < 3; ++i)
      if (c[i] < min[i] || c[i] >= max[i]) return false;
    return true;
  };
  const ColorBrick first = brick_of(min), last = brick_of(max - ColorCell{1, 1, 1});
  for (const auto& [coord, handle] : bricks_) {
    bool meets = true;
    for (int i = 0; i < 3; ++i) meets = meets && coord[i] >= first[i] && coord[i] <= last[i];
    if (!meets) continue;
    each_sum(coord, [&](const ColorCellSum& s) {
      constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
      if (inside(s.cell)) cells.push_back({s.cell, s.sum.mean(), s.side, std::uint32_t(std::min(kMost, s.sum.weight))});
    });
  }
  std::sort(cells.begin(), cells.end(), [](const CellColor& a, const CellColor& b) {
    return std::tuple(a.cell.z, a.cell.y, a.cell.x, a.side) < std::tuple(b.cell.z, b.cell.y, b.cell.x, b.side);
  });
  return cells;
}

std::unique_ptr<ColorGrid> ColorGrid::reduced() const {
  auto coarse = std::make_unique<ColorGrid>(store_, memory_bytes_);
  parallel_for(std::int64_t(bricks_.size()), [&](std::int64_t i) {
    std::vector<ColorCellSum> sums;
    each_sum(bricks_[std::size_t(i)].first, [&](const ColorCellSum& s) {
      sums.push_back({half_of(s.cell), s.side, 0, s.sum});
    });
    coarse->add(sums);
  });
  coarse->finish([](ColorBrick) { return [](ColorCell) { return ~std::uint32_t(0); }; });
  return coarse;
}

std::pair<ColorCell, ColorCell> ColorGrid::bounds() const {
  if (bricks_.empty()) return {};
  ColorBrick lo = bricks_.front().first, hi = lo;
  for (const auto& [coord, handle] : bricks_) {
    for (int i = 0; i < 3; ++i) lo[i] = std::min(lo[i], coord[i]), hi[i] = std::max(hi[i], coord[i]);
  }
  const auto cell = [](ColorBrick b) { return ColorCell{b.x * kEdge, b.y * kEdge, b.z * kEdge}; };
  return {cell(lo), cell(hi + ColorBrick{1, 1, 1})};
}

}  // namespace bp
