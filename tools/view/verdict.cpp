#include "tools/view/verdict.h"

#include <algorithm>

namespace bp {

namespace {

Json at(const Json& from, const char* path) {
  return from.value(Json::json_pointer(path), Json());
}

/// Returns the findings of a level that is refuted, as "touching: 15, outside: 1481"; null if there is none.
Json findings_of(const Json& v) {
  const auto found = v.find("findings");
  if (found == v.end() || !found->is_object()) return {};
  std::string text;
  for (const auto& [name, finding] : found->items()) {
    const Json count = at(finding, "/count");
    if (!count.is_number_unsigned() || count.get<std::uint64_t>() == 0) continue;
    std::string words = name;
    std::replace(words.begin(), words.end(), '_', ' ');
    text += (text.empty() ? "" : ", ") + words + ": " + count.dump();
  }
  return text.empty() ? Json() : Json(text);
}

/// Returns why the answer is not yes: what bpcheck says, or what it found.
Json why_of(const Json& v) {
  const Json why = at(v, "/why");
  return why.is_null() && at(v, "/answer") == "refuted" ? findings_of(v) : why;
}

Json brief_level(const Json& v) {
  return {{"answer", at(v, "/answer")},
          {"triangles", at(v, "/proxy/triangles")},
          {"volume", at(v, "/measures/volume")},
          {"volume_ratio", at(v, "/measures/volume_ratio")},
          {"farthest", at(v, "/measures/proxy_to_scene/at_most")}};
}

}  // namespace

Json brief_verdict(const std::string& text) {
  const Json all = Json::parse(text, nullptr, false);
  if (!all.is_object()) return {};
  Json levels = Json::array(), why = why_of(all);
  if (const auto found = all.find("levels"); found != all.end()) {
    for (const Json& level : *found) {
      levels.push_back(brief_level(level));
      if (why.is_null()) why = why_of(level);
    }
  } else if (all.contains("proxy")) {
    levels.push_back(brief_level(all));
  }
  return {{"answer", at(all, "/answer")}, {"why", why}, {"levels", levels}};
}

}  // namespace bp
