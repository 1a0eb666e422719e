#pragma once
#include <string_view>

namespace bp {

/// Returns whether the whole name fits the pattern: * stands for any characters, ? for one. Cost: at most the product
/// of their lengths.
[[nodiscard]] inline bool fits_pattern(std::string_view name, std::string_view pattern) {
  std::size_t n = 0, p = 0, star = std::string_view::npos, after_star = 0;
  while (n < name.size()) {
    if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n]) && pattern[p] != '*') {
      ++n, ++p;
    } else if (p < pattern.size() && pattern[p] == '*') {
      star = p++, after_star = n;
    } else if (star != std::string_view::npos) {
      p = star + 1, n = ++after_star;  // the last star takes one more
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

}  // namespace bp
