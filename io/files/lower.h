#pragma once
#include <cctype>
#include <string>
#include <string_view>

namespace bp {

/// Returns the text with ASCII letters in lower case, for comparing names of formats and keywords.
[[nodiscard]] inline std::string lower(std::string_view text) {
  std::string s(text);
  for (char& c : s) c = char(std::tolower(static_cast<unsigned char>(c)));
  return s;
}

}  // namespace bp
