#include "io/files/utf8.h"

#include <cstdint>
#include <nlohmann/json.hpp>

namespace bp {

bool is_utf8(const std::string& text) {
  try {
    (void)nlohmann::json(text).dump();
    return true;
  } catch (const nlohmann::json::exception&) {
    return false;
  }
}

std::string as_utf8(const std::string& text) {
  if (is_utf8(text)) return text;
  std::string out;
  for (const char c : text) {
    const auto byte = std::uint8_t(c);
    if (byte < 0x80) {
      out += c;
    } else {  // two bytes: 110xxxxx 10xxxxxx
      out += char(0xC0 | byte >> 6);
      out += char(0x80 | (byte & 0x3F));
    }
  }
  return out;
}

}  // namespace bp
