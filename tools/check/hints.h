#pragma once
#include <string>

#include "tools/common/mesh_extras.h"

namespace bp {

/// Nothing where the file cannot be read again: a hint is no reason to fail, or to wait for a pipe.
[[nodiscard]] MeshExtras extras_of(const std::string& path);

/// What may be behind the failure of the file `proxy` to enclose the file `scene` (or with `inside` to lie within it):
/// one sentence from what the files say of their making. Empty: they say nothing of it. moved: by --origin.
[[nodiscard]] std::string enclosure_hint(const std::string& scene, const std::string& proxy, bool inside, bool moved);
/// The same of a content of a tileset.
[[nodiscard]] std::string fit_hint(const std::string& content);

}  // namespace bp
