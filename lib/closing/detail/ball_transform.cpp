// The power transform  m(p) = min over seeds q of |p - q|^2 - w(q),  one axis after the other (squared Euclidean
// distances are separable: Saito and Toriwaki 1994; the offset of each seed is carried along). Differences from the
// textbook form:
// - Only m < 0 matters, so every pass stops at 0 and looks no further than R = floor(sqrt(w_max - 1)). Values stay in
//   [-w_max, 0]: 16 bits for scales up to 128 voxels.
// - x: 64 voxels of a row at once. A row gives min over its seeds s of (x - s)^2 - w(s), one vector minimum per seed.
//   With one w for the row, only the ends of runs of seeds and the nearest seed to either side count.
// - y: for 64 voxels, the minimum over the rows within R that hold seeds, of the row's values + dy^2.
// - z: with w at the seed nothing is left to minimise. A seed that reaches a slice at value m < 0 reaches the slices
//   within dz^2 < -m, so two sweeps that carry "slices to go" decide all voxels, whatever R is. With w at the target
//   the minimum itself is compared, over the slices within the target's own reach.
// - A pass runs only where a target needs it: on rows within R in z of a word that holds one.
// ball_passes.h has the passes over rows. This file decides where and when they run.
#include "lib/closing/detail/ball_transform.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <type_traits>

#include "lib/closing/detail/ball_passes.h"
#include "lib/closing/detail/simd.h"

namespace bp::detail {

namespace {

constexpr std::size_t kFieldBytes = std::size_t(4) << 20;  // of the values of a block of rows, at most
constexpr std::int32_t kSmallBound = 1 << 14;              // largest w for 16-bit values

/// The seeds of one row around a word: the word itself and the words to either side within reach.
struct SeedWords {
  explicit SeedWords(std::int32_t radius) : side((radius + 63) / 64) {
    words.resize(std::size_t(2 * side + 1));
    if (side == 0) return;
    const std::int32_t outer = radius - 64 * (side - 1);  // bits of the outermost words, 1 .. 64
    left_mask = ~std::uint64_t(0) << (64 - outer);
    right_mask = ~std::uint64_t(0) >> (64 - outer);
  }
  /// Goes to the row of words around the column that begins at x0, in a slice.
  void move_to(const ColumnBits& seeds, std::int32_t x0, std::int32_t z) {
    for (std::int32_t k = -side; k <= side; ++k) {
      const std::int32_t column = floor_div(x0 - seeds.box().min.x, 64) + k;
      words[std::size_t(k + side)] = column >= 0 && column < seeds.columns() ? seeds.slice(column, z) : nullptr;
    }
    y0 = seeds.box().min.y;
  }

  std::int32_t side;                        ///< words to either side
  std::vector<const std::uint64_t*> words;  ///< slices of the columns -side .. side; null if there is no such column
  std::int32_t y0 = 0;                      ///< row of the first word of a slice
  std::uint64_t left_mask = ~std::uint64_t(0), right_mask = ~std::uint64_t(0);  ///< bits in reach of the outer words
  [[nodiscard]] std::uint64_t bits(std::int32_t k, std::int32_t y) const {
    const std::uint64_t* w = words[std::size_t(k + side)];
    if (w == nullptr) return 0;
    return w[y - y0] & (k == -side ? left_mask : k == side ? right_mask : ~std::uint64_t(0));
  }
  static constexpr std::int32_t kNone = std::numeric_limits<std::int32_t>::min();
  /// Returns the nearest seeds of row y to the left and to the right of the middle word; kNone: there is none.
  [[nodiscard]] std::array<std::int32_t, 2> nearest(std::int32_t y) const {
    std::int32_t left = kNone, right = kNone;
    for (std::int32_t k = 1; k <= side && left == kNone; ++k) {
      if (const std::uint64_t word = bits(-k, y)) left = -64 * k + 63 - std::countl_zero(word);
    }
    for (std::int32_t k = 1; k <= side && right == kNone; ++k) {
      if (const std::uint64_t word = bits(k, y)) right = 64 * k + std::countr_zero(word);
    }
    return {left, right};
  }
};

/// Sets the marks of the rows [y0, y0 + count) in which a word of the column holds a target. `marks`: for kBlockRows
/// rows of each slice of the targets. Returns whether there is any.
bool mark_targets(const ColumnBits& targets, std::int32_t column, std::int32_t y0, std::int32_t count,
                  std::uint16_t mark, std::uint16_t* marks) {
  bool any = false;
  for (std::int32_t z = targets.box().min.z; z < targets.box().max.z; ++z, marks += kBlockRows) {
    const std::uint64_t* words = targets.slice(column, z) + (y0 - targets.box().min.y);
    for (std::int32_t i = 0; i < count; ++i) {
      if (words[i] == 0) continue;
      marks[i] = mark;
      any = true;
    }
  }
  return any;
}

template <class T>
T* room(std::vector<std::byte>& memory, std::size_t count) {
  if (memory.size() < count * sizeof(T)) memory.resize(count * sizeof(T));
  return reinterpret_cast<T*>(memory.data());
}

}  // namespace

/// One run: all columns of the targets, block of rows by block of rows. T is the type of values. Value is the type that
/// a slice keeps: T itself with the scale at the target, else the reach along z.
template <class T, class Value>
struct BallTransform::Columns {
  BallTransform& scratch;
  const ColumnBits& seeds;
  const BallRule& rule;
  ColumnBits& targets;
  const std::int32_t radius;  ///< R
  const T* squares = nullptr;
  T* rows = nullptr;
  Value* field = nullptr;         ///< [row of the block][slice][64]
  std::uint16_t* need = nullptr;  ///< [slice][row]: 1 + slices to the farthest end of a target's reach; 0: not needed
  /// Slices of field and need: targets, and the seeds that they can meet.
  std::int32_t z0 = 0, slices = 0, block_rows = 0;
  std::size_t row_step = 0;  ///< values from one row of the field to the next
  SeedWords words;
  T top = 0;

  Columns(BallTransform& owner, const ColumnBits& q, const BallRule& r, ColumnBits& p)
      : scratch(owner), seeds(q), rule(r), targets(p), radius(ball_reach(r.bound)), words(radius) {
    const VoxelBox &t = targets.box(), &s = seeds.box();
    z0 = std::min(t.min.z, std::max(s.min.z, t.min.z - radius));
    slices = std::max(t.max.z, std::min(s.max.z, t.max.z + radius)) - z0;
    row_step = std::size_t(slices | 1) * kLanes;  // odd: rows must not share a cache set
    block_rows =
        std::int32_t(std::clamp<std::size_t>(kFieldBytes / (row_step * sizeof(Value)), 8, std::size_t(kBlockRows)));
    field = room<Value>(scratch.field_, row_step * std::size_t(block_rows));
    rows = room<T>(scratch.rows_, std::size_t(block_rows + 2 * radius) * kLanes);
    scratch.row_y_.resize(std::size_t(block_rows + 2 * radius));
    scratch.need_.resize(std::size_t(slices) * kBlockRows);
    need = scratch.need_.data();
    scratch.present_.resize(std::size_t(slices));
    make_squares();
    top = T(std::bit_floor(unsigned(radius)));
  }

  void make_squares() {
    const std::int32_t half = radius + 2 * kLanes;
    T* table = room<T>(scratch.squares_, std::size_t(2 * half));
    // Squares are saturated at the largest bound: minus any w <= bound they are still not negative.
    for (std::int32_t i = -half; i < half; ++i)
      table[i + half] = T(std::min<std::int64_t>(std::int64_t(i) * i, rule.bound));
    squares = table + half;
  }

  void run() {
    const VoxelBox& box = targets.box();
    for (std::int32_t column = 0; column < targets.columns(); ++column) {
      for (std::int32_t y = box.min.y; y < box.max.y; y += block_rows)
        run_block(column, y, std::min(block_rows, box.max.y - y));
    }
  }

  /// Works on rows [y0, y0 + count) of one column.
  void run_block(std::int32_t column, std::int32_t y0, std::int32_t count) {
    std::fill_n(need, std::size_t(slices) * kBlockRows, std::uint16_t(0));
    if (!mark_targets(targets, column, y0, count, std::uint16_t(radius + 1),
                      need + std::size_t(targets.box().min.z - z0) * kBlockRows))
      return;
    spread(need, slices);
    const std::int32_t x0 = targets.box().min.x + 64 * column;
    for (std::int32_t i = 0; i < slices; ++i) run_slice(x0, y0, i);
    for (std::int32_t i = 0; i < count; ++i) decide_row(column, x0, y0, i);
  }

  /// Runs the x and y passes of slice z0 + i: fills the field where it is needed.
  void run_slice(std::int32_t x0, std::int32_t y0, std::int32_t i) {
    const std::uint16_t* wanted = need + std::size_t(i) * kBlockRows;
    std::int32_t first = 0, last = block_rows - 1;
    while (first <= last && wanted[first] == 0) ++first;
    while (first <= last && wanted[last] == 0) --last;
    scratch.present_[std::size_t(i)] = 0;
    if (first > last) return;
    const std::int32_t found = collect_rows(x0, y0 + first - radius, y0 + last + radius + 1, z0 + i);
    Value* out = field + std::size_t(i) * kLanes;
    if (found == 0) {
      for (std::int32_t y = first; y <= last; ++y) std::fill_n(out + std::size_t(y) * row_step, kLanes, Value(0));
    } else {
      y_pass(rows, RowPass{scratch.row_y_.data(), found, y0, radius, wanted, row_step}, top, out);
    }
    scratch.present_[std::size_t(i)] = found != 0;
  }

  /// x pass of the rows y in [begin, end) of slice z that hold a seed within reach of the column. Returns their number.
  std::int32_t collect_rows(std::int32_t x0, std::int32_t begin, std::int32_t end, std::int32_t z) {
    const VoxelBox& box = seeds.box();
    if (z < box.min.z || z >= box.max.z) return 0;
    begin = std::max(begin, box.min.y);
    end = std::min(end, box.max.y);
    words.move_to(seeds, x0, z);
    std::int32_t found = 0;
    for (std::int32_t y = begin; y < end; ++y) {
      std::uint64_t any = 0;
      for (std::int32_t k = -words.side; k <= words.side; ++k) any |= words.bits(k, y);
      if (any == 0) continue;
      x_pass(x0, y, z, rows + std::size_t(found) * kLanes);
      scratch.row_y_[std::size_t(found++)] = y;
    }
    return found;
  }

  void x_pass(std::int32_t x0, std::int32_t y, std::int32_t z, T* row) {
    if (rule.scale != BallScale::at_seed) return x_pass_of_one(y, rule.bound, row);
    scratch.scales_.set(*rule.lattice, y, z, x0 - radius, x0 + 64 + radius);
    if (scratch.scales_.constant()) return x_pass_of_one(y, ball_bound(scratch.scales_.min()), row);
    std::fill_n(row, kLanes, T(0));
    for (std::int32_t k = -words.side; k <= words.side; ++k) {
      for (std::uint64_t bits = words.bits(k, y); bits != 0; bits &= bits - 1) {
        const std::int32_t s = 64 * k + std::countr_zero(bits);
        lower(squares - s, T(-ball_bound(scratch.scales_.at(x0 + s))), row);
      }
    }
  }

  /// x pass of a row whose seeds all have the same bound.
  void x_pass_of_one(std::int32_t y, std::int32_t bound, T* row) {
    const auto [left, right] = words.nearest(y);
    nearest(words.bits(0, y), left, right, SeedWords::kNone, T(bound), squares, row);
  }

  /// z pass of row y0 + i: clears the targets that no seed reaches.
  void decide_row(std::int32_t column, std::int32_t x0, std::int32_t y0, std::int32_t i) {
    const VoxelBox& box = targets.box();
    Line<Value> line{field + std::size_t(i) * row_step,
                     need + i,
                     slices,
                     targets.slice(column, box.min.z) + (y0 + i - box.min.y),
                     std::size_t(box.max.y - box.min.y),
                     box.min.z - z0,
                     box.max.z - box.min.z};
    if constexpr (std::is_same_v<T, Value>) {
      compare_line(line, x0, y0 + i);
    } else {
      z_sweep(line);
    }
  }

  void compare_line(const Line<Value>& line, std::int32_t x0, std::int32_t y) {
    T limit[kLanes];
    for (std::int32_t t = 0; t < line.target_count; ++t) {
      std::uint64_t& word = line.target[std::size_t(t) * line.target_step];
      if (word == 0) continue;
      const std::int32_t i = line.first_target + t;
      scratch.scales_.set(*rule.lattice, y, z0 + i, x0, x0 + 64);
      scratch.scales_.bounds(x0, limit);
      for (T& w : limit) w = T(w - rule.bound);
      word &= z_minimum(line.values, scratch.present_.data(), i, slices, ball_reach(ball_bound(scratch.scales_.max())),
                        limit);
    }
  }
};

void BallTransform::run(const ColumnBits& seeds, const BallRule& rule, ColumnBits& targets) {
  if (targets.box().empty()) return;
  const bool small = rule.bound <= kSmallBound;
  if (rule.scale == BallScale::at_target) {
    small ? Columns<std::int16_t, std::int16_t>(*this, seeds, rule, targets).run()
          : Columns<std::int32_t, std::int32_t>(*this, seeds, rule, targets).run();
  } else {
    small ? Columns<std::int16_t, std::uint8_t>(*this, seeds, rule, targets).run()
          : Columns<std::int32_t, std::uint16_t>(*this, seeds, rule, targets).run();
  }
}

}  // namespace bp::detail
