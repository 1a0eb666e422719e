#pragma once
#include <array>
#include <bit>
#include <cstdint>

/// Numbers side by side, as vectors of 16 bytes of GCC and Clang: one instruction each on all processors that we build
/// for.
namespace bp {

typedef std::int32_t FourInts __attribute__((vector_size(16)));
typedef float FourFloats __attribute__((vector_size(16)));

typedef double TwoDoubles __attribute__((vector_size(16)));
using TwoLongs = decltype(TwoDoubles{} < TwoDoubles{});  // int64_t is long in both, and Clang compares to long long

/// Returns a bit for each lane of two comparisons' results (all ones where true), the four lanes of `low` first. It has
/// no branches, because the processor could only guess them.
[[nodiscard]] inline std::uint32_t bits_of(FourInts low, FourInts high) {
#ifdef __SSE__
  const auto signs = [](FourInts lanes) {
    return std::uint32_t(__builtin_ia32_movmskps(std::bit_cast<FourFloats>(lanes)));
  };
  return signs(low) | signs(high) << 4;
#else
  const FourInts hits = (low & FourInts{1, 2, 4, 8}) | (high & FourInts{16, 32, 64, 128});
  const auto halves = std::bit_cast<std::array<std::uint64_t, 2>>(hits);
  const std::uint64_t both = halves[0] | halves[1];
  return std::uint32_t(both | both >> 32);
#endif
}

[[nodiscard]] inline std::uint32_t bits_of(TwoLongs low, TwoLongs high) {
#ifdef __SSE2__
  const auto signs = [](TwoLongs lanes) {
    return std::uint32_t(__builtin_ia32_movmskpd(std::bit_cast<TwoDoubles>(lanes)));
  };
  return signs(low) | signs(high) << 2;
#else
  const TwoLongs hits = (low & TwoLongs{1, 2}) | (high & TwoLongs{4, 8});
  return std::uint32_t(hits[0] | hits[1]);
#endif
}

/// Returns whether a comparison holds in any lane.
[[nodiscard]] inline bool any(FourInts lanes) {
  const auto halves = std::bit_cast<std::array<std::uint64_t, 2>>(lanes);
  return (halves[0] | halves[1]) != 0;
}

}  // namespace bp
