#pragma once
#include <fmt/format.h>

#include <cstdint>
#include <string>

namespace bp {

/// Returns a 128-bit hash or checksum as 32 hexadecimal digits.
[[nodiscard]] inline std::string hex_of(std::uint64_t high, std::uint64_t low) {
  return fmt::format("{:016x}{:016x}", high, low);
}

}  // namespace bp
