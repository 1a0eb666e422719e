#pragma once
#include <cctype>
#include <string>
#include <string_view>

namespace bp {

/// ASCII letters in lower case, as names of formats and keywords are compared.
[[nodiscard]] inline std::string lower(std::string_view text) {
  std::string s(text);
  for (char& c : s) c = char(std::tolower(static_cast<unsigned char>(c)));
  return s;
}

}  // namespace bp
