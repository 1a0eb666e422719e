#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace bp {

/// Parses JSON. Names in Latin-1, as some exporters write them, become UTF-8. Throws bad_input if the text is too deep,
/// or if an object has a key twice: glTF forbids it (section 2.7), and programs disagree on which of the two counts.
/// Throws nlohmann::json::exception if the text is no JSON. `name`: the file's, for messages.
[[nodiscard]] nlohmann::json parse_json(const std::string& text, const std::string& name);

}  // namespace bp
