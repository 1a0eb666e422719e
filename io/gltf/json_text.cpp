#include "io/gltf/json_text.h"

#include <cstring>
#include <set>
#include <vector>

#include "io/files/json_shape.h"
#include "io/files/utf8.h"
#include "lib/core/error.h"

namespace bp {

namespace {

/// Returns the number of members that were kept: of two with one key, the last.
std::uint64_t members_of(const nlohmann::json& json) {
  std::uint64_t count = 0;
  std::vector<const nlohmann::json*> open{&json};
  while (!open.empty()) {
    const nlohmann::json& next = *open.back();
    open.pop_back();
    if (next.is_object()) count += next.size();
    for (const nlohmann::json& below : next) {
      if (below.is_structured()) open.push_back(&below);
    }
  }
  return count;
}

/// Returns a key that an object of a valid text has twice.
std::string repeated_key(const std::string& text) {
  std::vector<std::set<std::string>> open;  // the keys of the objects around the current place
  std::string repeated;
  const auto note_key = [&](int, nlohmann::json::parse_event_t event, const nlohmann::json& key) {
    if (event == nlohmann::json::parse_event_t::object_start) open.emplace_back();
    if (event == nlohmann::json::parse_event_t::object_end) open.pop_back();
    if (event == nlohmann::json::parse_event_t::key && !open.back().insert(key.get<std::string>()).second)
      repeated = key.get<std::string>();
    return true;
  };
  [[maybe_unused]] const nlohmann::json parsed = nlohmann::json::parse(text, note_key);
  return repeated;
}

nlohmann::json parse_checked(const std::string& text, const std::string& name) {
  const JsonShape shape = json_shape(text);
  if (shape.is_too_deep())
    fail(ErrorCode::bad_input, {Remedy::repair_file}, "{}: has objects and arrays {} deep, and at most {} are read",
         name, shape.deepest, JsonShape::kMostDeep);
  nlohmann::json json = nlohmann::json::parse(text);
  if (!json.is_structured() || members_of(json) == shape.members) return json;
  fail(ErrorCode::bad_input, {Remedy::repair_file}, "{}: has the key \"{}\" twice in one object", name,
       repeated_key(text));
}

}  // namespace

nlohmann::json parse_json(const std::string& text, const std::string& name) {
  try {
    return parse_checked(text, name);
  } catch (const nlohmann::json::parse_error& e) {
    if (std::strstr(e.what(), "UTF-8") == nullptr) throw;
  }
  return parse_checked(as_utf8(text), name);
}

}  // namespace bp
