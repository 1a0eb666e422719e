#pragma once
#include <cstdint>
#include <string>

namespace bp {

/// Returns "1 tile", "2 tiles". `one`: a noun whose plural ends in s.
[[nodiscard]] inline std::string counted(std::uint64_t n, const char* one) {
  return std::to_string(n) + " " + one + (n == 1 ? "" : "s");
}

/// Returns a text with blanks in place of line breaks and other control characters. Names of files may have them, and
/// could end a line of an output, or begin another.
[[nodiscard]] inline std::string one_line(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  return text;
}

}  // namespace bp
