#include "io/files/json_shape.h"

#include <algorithm>

namespace bp {

JsonShape json_shape(const std::string& text) {
  JsonShape shape;
  std::uint64_t depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"') in_string = !in_string;
    if (in_string) {
      i += c == '\\' ? 1 : 0;
      continue;
    }
    shape.members += c == ':' ? 1 : 0;  // a member has one colon outside of strings
    if (c == '{' || c == '[') shape.deepest = std::max(shape.deepest, ++depth);
    if ((c == '}' || c == ']') && depth > 0) --depth;
  }
  return shape;
}

}  // namespace bp
