#pragma once
#include <string>

namespace bp {

/// Returns whether the text is UTF-8, as JSON requires.
[[nodiscard]] bool is_utf8(const std::string& text);
/// Returns the text if it is UTF-8. Another text is taken for Latin-1, as older programs write names, and is converted.
/// The result can go into JSON.
[[nodiscard]] std::string as_utf8(const std::string& text);

}  // namespace bp
