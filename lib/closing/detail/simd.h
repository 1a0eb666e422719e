#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include "lib/core/clones.h"

/// Vectors of small integers, 64 voxels at a time. They are plain loops over the vector type of GCC and Clang, so that
/// one source serves SSE2, AVX2 and NEON.
namespace bp::detail {

constexpr int kLanes = 64;  ///< voxels of a word

/// 64 integers of type T as registers. `load` and `store` need no alignment. {} makes zeros.
template <class T>
struct Lanes {
  typedef T Vector __attribute__((vector_size(32)));
  typedef T Unaligned __attribute__((vector_size(32), aligned(1), may_alias));
  static constexpr int kCount = kLanes * int(sizeof(T)) / 32;
  Vector v[kCount];

  static BP_INLINE Lanes load(const T* p) {
    Lanes out{};
    for (int i = 0; i < kCount; ++i) out.v[i] = reinterpret_cast<const Unaligned*>(p)[i];
    return out;
  }
  BP_INLINE void store(T* p) const {
    for (int i = 0; i < kCount; ++i) reinterpret_cast<Unaligned*>(p)[i] = v[i];
  }
  /// this = min(this, p[0..63] + c)
  BP_INLINE void min_sum(const T* p, T c) {
    for (int i = 0; i < kCount; ++i) {
      const Vector b = reinterpret_cast<const Unaligned*>(p)[i] + c;
      v[i] = b < v[i] ? b : v[i];
    }
  }
  /// this = min(this, p[0..63])
  BP_INLINE void min(const T* p) {
    for (int i = 0; i < kCount; ++i) {
      const Vector b = reinterpret_cast<const Unaligned*>(p)[i];
      v[i] = b < v[i] ? b : v[i];
    }
  }
};

/// Returns bits: bit i is set if byte i is not zero.
BP_INLINE std::uint64_t nonzero_bits(const std::uint8_t* p) {
#if defined(__SSE2__)
  std::uint64_t bits = 0;
  for (int i = 0; i < 4; ++i) {
    const __m128i v = _mm_loadu_si128(reinterpret_cast<const __m128i*>(p) + i);
    const auto zero = unsigned(_mm_movemask_epi8(_mm_cmpeq_epi8(v, _mm_setzero_si128())));
    bits |= std::uint64_t(~zero & 0xFFFFU) << (16 * i);
  }
  return bits;
#else
  std::uint64_t bits = 0;
  for (int i = 0; i < kLanes; ++i) bits |= std::uint64_t(p[i] != 0) << i;
  return bits;
#endif
}

template <class U>
BP_INLINE std::uint64_t nonzero_bits(const U* p) {
  std::uint8_t bytes[kLanes];
  for (int i = 0; i < kLanes; ++i) bytes[i] = std::uint8_t(p[i] != 0);
  return nonzero_bits(bytes);
}

/// out[i] = -1 (all bits) where bit i is set, else 0.
template <class T>
struct ByteMasks {
  std::array<std::array<T, 8>, 256> rows{};
  constexpr ByteMasks() {
    for (unsigned b = 0; b < 256; ++b) {
      for (unsigned i = 0; i < 8; ++i) rows[b][i] = (b >> i) & 1 ? T(-1) : T(0);
    }
  }
};
template <class T>
inline constexpr ByteMasks<T> kByteMasks{};

}  // namespace bp::detail
