#include "lib/closing/detail/ball_passes.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <type_traits>

#include "lib/closing/detail/simd.h"

namespace bp::detail {

namespace {

/// `squares[i]` = i^2, saturated; row = min(0, (x - s)^2 - bound) for seed s.
template <class T>
BP_INLINE void nearest_seeds(std::uint64_t middle, std::int32_t left, std::int32_t right, std::int32_t none, T bound,
                             const T* squares, T* row) {
  Lanes<T> acc{};
  const std::uint64_t inner = middle & (middle << 1) & (middle >> 1);
  for (std::uint64_t edges = middle & ~inner; edges != 0; edges &= edges - 1)
    acc.min_sum(squares - std::countr_zero(edges), T(-bound));
  if (left != none) acc.min_sum(squares - left, T(-bound));
  if (right != none) acc.min_sum(squares - right, T(-bound));
  if (inner != 0) {
    T masks[kLanes];
    for (int i = 0; i < 8; ++i)
      std::memcpy(masks + 8 * i, kByteMasks<T>.rows[(inner >> (8 * i)) & 255].data(), 8 * sizeof(T));
    for (int i = 0; i < kLanes; ++i) masks[i] = T(masks[i] & T(-bound));
    acc.min(masks);
  }
  acc.store(row);
}

/// acc = min(acc, min over j of rows[j] + (row_y[j] - y)^2).
template <class T>
BP_INLINE void lowest_over_rows(const T* rows, const std::int32_t* row_y, std::int32_t count, std::int32_t y,
                                Lanes<T>& acc) {
  for (std::int32_t j = 0; j < count; ++j) {
    const std::int32_t dy = row_y[j] - y;
    acc.min_sum(rows + std::size_t(j) * kLanes, T(dy * dy));
  }
}

/// For value m: the number of slices, its own included, that a seed of this value reaches. That is the number of dz >=
/// 0 with m + dz^2 < 0, which is floor(sqrt(-m - 1)) + 1 if m < 0. The root is found bit by bit from `top` down.
template <class T, class Reach>
BP_INLINE void store_reach(Lanes<T>& acc, T top, Reach* out) {
  using Vector = typename Lanes<T>::Vector;
  T reach[kLanes];
  for (int i = 0; i < Lanes<T>::kCount; ++i) {
    const Vector n = ~acc.v[i];  // -m - 1
    Vector root{};
    for (T b = top; b > 0; b = T(b >> 1)) {
      const Vector c = root + b;
      root += (c * c <= n) & b;
    }
    acc.v[i] = root - (n >= 0);  // a mask is -1
  }
  acc.store(reach);
  for (int i = 0; i < kLanes; ++i) out[i] = Reach(reach[i]);
}

/// If Out differs from T, the values are how far seeds reach along z; else the minima themselves.
template <class T, class Out>
BP_INLINE void pass_rows(const T* rows, const RowPass& p, T top, Out* out) {
  std::int32_t lo = 0, hi = 0;
  for (std::int32_t i = 0; i < kBlockRows; ++i) {
    if (p.need[i] == 0) continue;
    const std::int32_t y = p.y0 + i;
    while (lo < p.count && p.row_y[lo] < y - p.radius) ++lo;
    while (hi < p.count && p.row_y[hi] <= y + p.radius) ++hi;
    Lanes<T> acc{};
    lowest_over_rows(rows + std::size_t(lo) * kLanes, p.row_y + lo, hi - lo, y, acc);
    if constexpr (std::is_same_v<T, Out>) {
      acc.store(out + std::size_t(i) * p.step);
    } else {
      store_reach(acc, top, out + std::size_t(i) * p.step);
    }
  }
}

/// Carries the slices to go up and then down. A target is reached if some are left.
template <class T>
BP_INLINE void sweep_line(const Line<T>& line) {
  using Vector = typename Lanes<T>::Vector;
  Lanes<T> carry{};
  const auto carry_to = [&](std::int32_t z) __attribute__((always_inline)) {
    const Lanes<T> here = Lanes<T>::load(line.values + std::size_t(z) * kLanes);
    for (int i = 0; i < Lanes<T>::kCount; ++i) {
      const Vector less = carry.v[i] - Vector((carry.v[i] != 0) & 1);
      carry.v[i] = less > here.v[i] ? less : here.v[i];
    }
  };
  for (std::int32_t z = 0; z < line.slices; ++z) {
    if (line.need[std::size_t(z) * kBlockRows] == 0) {
      carry = {};
      continue;
    }
    carry_to(z);
    carry.store(line.values + std::size_t(z) * kLanes);
  }
  carry = {};
  for (std::int32_t z = line.slices - 1; z >= 0; --z) {
    if (line.need[std::size_t(z) * kBlockRows] == 0) {
      carry = {};
      continue;
    }
    carry_to(z);
    const std::int32_t t = z - line.first_target;
    if (t < 0 || t >= line.target_count) continue;
    std::uint64_t& word = line.target[std::size_t(t) * line.target_step];
    if (word == 0) continue;
    T left[kLanes];
    carry.store(left);
    word &= nonzero_bits(left);
  }
}

/// Returns bits of the 64 targets at slice z. A bit is set if the minimum over the slices within `reach` is below
/// `limit`.
template <class T>
BP_INLINE std::uint64_t below_limit(const T* values, const std::uint8_t* present, std::int32_t z, std::int32_t slices,
                                    std::int32_t reach, const T* limit) {
  Lanes<T> acc{};
  const std::int32_t end = std::min(z + reach + 1, slices);
  for (std::int32_t i = std::max(z - reach, 0); i < end; ++i) {
    if (present[i] != 0) acc.min_sum(values + std::size_t(i) * kLanes, T((i - z) * (i - z)));
  }
  T low[kLanes];
  acc.store(low);
  std::uint8_t yes[kLanes];
  for (int i = 0; i < kLanes; ++i) yes[i] = low[i] < limit[i] ? 255 : 0;
  return nonzero_bits(yes);
}

}  // namespace

BP_CLONES void spread(std::uint16_t* need, std::int32_t slices) {
  const auto pull = [](const std::uint16_t* from, std::uint16_t* to) __attribute__((always_inline)) {
    for (int y = 0; y < kBlockRows; ++y) {
      const std::uint16_t less = from[y] > 0 ? std::uint16_t(from[y] - 1) : std::uint16_t(0);
      to[y] = std::max(to[y], less);
    }
  };
  for (std::int32_t z = 1; z < slices; ++z) pull(need + (z - 1) * kBlockRows, need + z * kBlockRows);
  for (std::int32_t z = slices - 2; z >= 0; --z) pull(need + (z + 1) * kBlockRows, need + z * kBlockRows);
}

BP_CLONES void nearest(std::uint64_t middle, std::int32_t left, std::int32_t right, std::int32_t none,
                       std::int16_t bound, const std::int16_t* squares, std::int16_t* row) {
  nearest_seeds(middle, left, right, none, bound, squares, row);
}

BP_CLONES void nearest(std::uint64_t middle, std::int32_t left, std::int32_t right, std::int32_t none,
                       std::int32_t bound, const std::int32_t* squares, std::int32_t* row) {
  nearest_seeds(middle, left, right, none, bound, squares, row);
}

BP_CLONES void lower(const std::int16_t* squares, std::int16_t c, std::int16_t* row) {
  Lanes<std::int16_t> acc = Lanes<std::int16_t>::load(row);
  acc.min_sum(squares, c);
  acc.store(row);
}

BP_CLONES void lower(const std::int32_t* squares, std::int32_t c, std::int32_t* row) {
  Lanes<std::int32_t> acc = Lanes<std::int32_t>::load(row);
  acc.min_sum(squares, c);
  acc.store(row);
}

BP_CLONES void y_pass(const std::int16_t* rows, const RowPass& p, std::int16_t top, std::uint8_t* out) {
  pass_rows(rows, p, top, out);
}

BP_CLONES void y_pass(const std::int32_t* rows, const RowPass& p, std::int32_t top, std::uint16_t* out) {
  pass_rows(rows, p, top, out);
}

BP_CLONES void y_pass(const std::int16_t* rows, const RowPass& p, std::int16_t top, std::int16_t* out) {
  pass_rows(rows, p, top, out);
}

BP_CLONES void y_pass(const std::int32_t* rows, const RowPass& p, std::int32_t top, std::int32_t* out) {
  pass_rows(rows, p, top, out);
}

BP_CLONES void z_sweep(const Line<std::uint8_t>& line) {
  sweep_line(line);
}

BP_CLONES void z_sweep(const Line<std::uint16_t>& line) {
  sweep_line(line);
}

BP_CLONES std::uint64_t z_minimum(const std::int16_t* values, const std::uint8_t* present, std::int32_t z,
                                  std::int32_t slices, std::int32_t reach, const std::int16_t* limit) {
  return below_limit(values, present, z, slices, reach, limit);
}

BP_CLONES std::uint64_t z_minimum(const std::int32_t* values, const std::uint8_t* present, std::int32_t z,
                                  std::int32_t slices, std::int32_t reach, const std::int32_t* limit) {
  return below_limit(values, present, z, slices, reach, limit);
}

}  // namespace bp::detail
