#pragma once
// Catch2 2.13 (Debian 12) or 3 (Ubuntu 24.04), one include and version 3's names for both.
#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
using Catch::Approx;
using Catch::Matchers::ContainsSubstring;
#else
#include <catch2/catch.hpp>
#include <string>
inline auto ContainsSubstring(const std::string& text) {
  return Catch::Contains(text);
}
#endif
