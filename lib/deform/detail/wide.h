#pragma once
#include "lib/deform/formulas/numbers.h"

/// Doubles side by side, for kWide points at a time.
namespace bp::detail {

constexpr int kWide = 4;
typedef double Wide __attribute__((vector_size(8 * kWide)));
typedef long long WideBits __attribute__((vector_size(8 * kWide)));  ///< results of comparisons: all ones where true
using WideVec = Vec<Wide>;

/// Returns bits: bit k says that lane k is true.
BP_INLINE unsigned bits_of(const WideBits& lanes) {
  unsigned bits = 0;
  for (int i = 0; i < kWide; ++i) bits |= unsigned(lanes[i] & 1) << i;
  return bits;
}

template <>
struct Numbers<Wide> {
  using Bits = WideBits;
  static BP_INLINE void root(Wide& x) {
    for (int i = 0; i < kWide; ++i) x[i] = std::sqrt(x[i]);
  }
  static BP_INLINE bool any(const WideBits& condition) { return bits_of(condition) != 0; }
  static BP_INLINE void bits(const Wide& x, Bits& out) { out = (WideBits)x; }
  static BP_INLINE void number(const Bits& bits, Wide& out) { out = (Wide)bits; }
};

}  // namespace bp::detail
