#pragma once
#include <algorithm>
#include <bit>
#include <utility>
#include <vector>

#include "lib/grid/bit_box.h"

/// The empty voxels of a tile as runs along x, each with a provisional label of its connected component.
///
/// Runs come (begin, end) from the packed words. Each is united with the runs that overlap it in the row before and in
/// the slice before. Only two slices of runs are alive; a second scan repeats the same provisional labels instead of
/// storing them.
namespace bp::detail {

struct Run {
  std::int32_t begin, end;  ///< voxels from the tile's min.x
  std::uint32_t label;
};

/// Returns the bits [begin, end) of a word.
[[nodiscard]] inline std::uint64_t bit_range(std::int32_t begin, std::int32_t end) {
  return (~std::uint64_t(0) << begin) & (~std::uint64_t(0) >> (64 - end));
}

/// Calls emit(begin, end) for each run of zero bits in bits [first, last) of `row`. Positions count from `first`.
template <class Emit>
void for_empty_runs(const std::uint64_t* row, std::int32_t first, std::int32_t last, const Emit& emit) {
  std::int32_t open = -1;  // where the run that reaches the current word begins, in bits of the row
  for (std::int32_t base = first & ~63; base < last; base += 64) {
    std::uint64_t empty = ~row[base / 64] & bit_range(std::max(first - base, 0), std::min(last - base, 64));
    if (empty == ~std::uint64_t(0)) {
      if (open < 0) open = base;
      continue;
    }
    if (open >= 0) {
      const int ones = std::countr_one(empty);
      emit(open - first, base + ones - first);
      open = -1;
      empty &= empty + 1;  // clears the trailing ones
    }
    while (empty != 0) {
      const int begin = std::countr_zero(empty), length = std::countr_one(empty >> begin);
      if (begin + length == 64) {
        open = base + begin;
        break;
      }
      emit(base + begin - first, base + begin + length - first);
      empty &= empty + (std::uint64_t(1) << begin);  // clears the lowest run of ones
    }
  }
  if (open >= 0) emit(open - first, last - first);
}

/// The runs of one slice, row by row.
struct Slice {
  std::vector<Run> runs;
  std::vector<std::uint32_t> rows;  ///< rows[y] .. rows[y + 1] are the runs of row y

  void clear() {
    runs.clear();
    rows.assign(1, 0);
  }
  void reserve_row(std::int32_t voxels) {
    const std::size_t need = runs.size() + std::size_t(voxels) / 2 + 1;
    if (runs.capacity() < need) runs.reserve(2 * need);
  }
  [[nodiscard]] const Run* begin(std::int32_t y) const { return runs.data() + rows[std::size_t(y)]; }
  [[nodiscard]] const Run* end(std::int32_t y) const { return runs.data() + rows[std::size_t(y) + 1]; }
};

constexpr std::uint32_t kNoLabel = ~std::uint32_t(0);

/// A cursor over the runs of a neighbouring row. Calls must come with ascending runs.
class Neighbours {
 public:
  Neighbours(const Run* begin, const Run* end) : at_(begin), end_(end) {}
  /// Calls touch(label) for each run that overlaps [begin, end).
  template <class Touch>
  void overlaps(std::int32_t begin, std::int32_t end, const Touch& touch) {
    while (at_ != end_ && at_->end <= begin) ++at_;
    for (const Run* r = at_; r != end_ && r->begin < end; ++r) touch(r->label);
  }

 private:
  const Run *at_, *end_;
};

/// Returns true if bits [first, last) of `row`, both multiples of 64, are zero.
[[nodiscard]] inline bool empty_words(const std::uint64_t* row, std::int32_t first, std::int32_t last) {
  std::uint64_t any = 0;
  for (std::int32_t word = first / 64; word < last / 64; ++word) any |= row[word];
  return any == 0;
}

/// Scans the empty runs of `tile` in a fixed order. A run gets the provisional label of the first run that overlaps it
/// in the row before, else in the slice before, else fresh(); unite(a, b) reports every other overlap. Then visit(run,
/// y, z) is called, with y and z from the tile's corner. Two scans of the same bits give the same labels.
template <class Fresh, class Unite, class Visit>
class RunScan {
 public:
  RunScan(const BitBox& solid, const VoxelBox& tile, const Fresh& fresh, const Unite& unite, const Visit& visit)
      : solid_(solid),
        tile_(tile),
        first_(tile.min.x - solid.box().min.x),
        last_(first_ + tile.size().x),
        fresh_(fresh),
        unite_(unite),
        visit_(visit) {}

  void operator()() {
    const VoxelCoord size = tile_.size();
    const bool aligned = first_ % 64 == 0 && size.x % 64 == 0;
    for (std::int32_t z = 0; z < size.z; ++z) {
      now_.clear();
      for (std::int32_t y = 0; y < size.y; ++y) {
        now_.reserve_row(size.x);  // pointers to the adjacent runs stay valid
        const std::uint64_t* const row = solid_.row(tile_.min.y + y, tile_.min.z + z);
        if (aligned && y > 0 && beside_is_empty(y, size.x) && empty_words(row, first_, last_)) {
          add_empty_row(y, z);
        } else {
          add_row(row, y, z);
        }
        now_.rows.push_back(std::uint32_t(now_.runs.size()));
      }
      std::swap(before_, now_);
    }
  }

 private:
  [[nodiscard]] bool beside_is_empty(std::int32_t y, std::int32_t width) const {
    return now_.end(y - 1) - now_.begin(y - 1) == 1 && now_.runs.back().begin == 0 && now_.runs.back().end == width;
  }

  /// Adds an empty row. Most empty rows lie next to empty ones: the adjacent run takes them in, whatever lies below.
  void add_empty_row(std::int32_t y, std::int32_t z) {
    const std::uint32_t label = now_.runs.back().label;
    if (z > 0) {
      for (const Run* r = before_.begin(y); r != before_.end(y); ++r) {
        if (r->label != label) unite_(label, r->label);
      }
    }
    now_.runs.push_back({0, last_ - first_, label});
    visit_(now_.runs.back(), y, z);
  }

  void add_row(const std::uint64_t* row, std::int32_t y, std::int32_t z) {
    Neighbours beside = y > 0 ? Neighbours(now_.begin(y - 1), now_.end(y - 1)) : Neighbours(nullptr, nullptr);
    Neighbours below = z > 0 ? Neighbours(before_.begin(y), before_.end(y)) : Neighbours(nullptr, nullptr);
    for_empty_runs(row, first_, last_, [&](std::int32_t begin, std::int32_t end) {
      std::uint32_t label = kNoLabel;
      const auto touch = [&](std::uint32_t other) {
        if (label == kNoLabel) {
          label = other;
        } else if (label != other) {
          unite_(label, other);
        }
      };
      beside.overlaps(begin, end, touch);
      below.overlaps(begin, end, touch);
      if (label == kNoLabel) label = fresh_();
      now_.runs.push_back({begin, end, label});
      visit_(now_.runs.back(), y, z);
    });
  }

  const BitBox& solid_;
  const VoxelBox tile_;
  const std::int32_t first_, last_;  // bits of a row
  const Fresh& fresh_;
  const Unite& unite_;
  const Visit& visit_;
  Slice before_, now_;
};

/// Scans the empty runs of `tile`: see RunScan.
template <class Fresh, class Unite, class Visit>
void scan(const BitBox& solid, const VoxelBox& tile, const Fresh& fresh, const Unite& unite, const Visit& visit) {
  RunScan(solid, tile, fresh, unite, visit)();
}

}  // namespace bp::detail
