#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

namespace bp {

/// Returns the number of bits that are set. It takes 2 us a brick; std::popcount, a call for each word in the baseline
/// instruction set, takes 20.
[[nodiscard]] std::uint64_t count_bits(std::span<const std::byte> bytes);

}  // namespace bp
