#pragma once
#include <string>

namespace bp {

/// What may be behind the failure of the file `proxy` to enclose the file `scene` (or with `inside` to lie within it):
/// one sentence from what the files say of their making. Empty: they say nothing of it. moved: by --origin.
[[nodiscard]] std::string enclosure_hint(const std::string& scene, const std::string& proxy, bool inside, bool moved);
/// The same of a content of a tileset.
[[nodiscard]] std::string fit_hint(const std::string& content);

}  // namespace bp
