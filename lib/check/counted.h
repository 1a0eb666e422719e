#pragma once
#include <cstdint>
#include <string>

namespace bp {

/// Returns "1 tile", "2 tiles". `one`: a noun whose plural ends in s.
[[nodiscard]] inline std::string counted(std::uint64_t n, const char* one) {
  return std::to_string(n) + " " + one + (n == 1 ? "" : "s");
}

}  // namespace bp
