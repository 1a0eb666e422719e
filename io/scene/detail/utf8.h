#pragma once
#include <string>

namespace bp {

/// Returns the text if it is UTF-8. Else it is taken for Latin-1, as older programs write names, and is converted:
/// every byte is a letter then, so the result can go into JSON.
[[nodiscard]] std::string as_utf8(const std::string& text);

}  // namespace bp
