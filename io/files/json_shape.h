#pragma once
#include <cstdint>
#include <string>

namespace bp {

/// The size of a JSON text. It is not parsed, so the text may be broken.
struct JsonShape {
  static constexpr std::uint64_t kMostDeep = 512;  ///< of real files; 64 tiles within each other take 130
  std::uint64_t members = 0;                       ///< of all objects together
  std::uint64_t deepest = 0;                       ///< objects and arrays within each other
  /// Returns whether copying the parsed document, or writing it, would take too much of the stack.
  [[nodiscard]] bool is_too_deep() const { return deepest > kMostDeep; }
};
[[nodiscard]] JsonShape json_shape(const std::string& text);

}  // namespace bp
