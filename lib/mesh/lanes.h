#pragma once
#include <array>
#include <bit>
#include <cstdint>

/// Numbers side by side, as vectors of four of GCC and Clang: one instruction each on all that we build for.
namespace bp {

typedef std::int32_t FourInts __attribute__((vector_size(16)));
typedef float FourFloats __attribute__((vector_size(16)));

/// Bit k: lane k of two comparisons' results (all ones where true, low four lanes first). No branches: they would be
/// guesses.
[[nodiscard]] inline std::uint32_t bits_of(FourInts low, FourInts high) {
  const FourInts hits = (low & FourInts{1, 2, 4, 8}) | (high & FourInts{16, 32, 64, 128});
  const auto halves = std::bit_cast<std::array<std::uint64_t, 2>>(hits);
  const std::uint64_t both = halves[0] | halves[1];
  return std::uint32_t(both | both >> 32);
}

/// Whether a comparison holds in any lane.
[[nodiscard]] inline bool any(FourInts lanes) {
  const auto halves = std::bit_cast<std::array<std::uint64_t, 2>>(lanes);
  return (halves[0] | halves[1]) != 0;
}

}  // namespace bp
