#pragma once
#include <string>

#include "lib/grid/stream.h"

/// The scene files that a brick stream names (docs/brick-stream.md, section 4), as JSON.
namespace bp::detail {

/// Returns the JSON; empty if there is nothing to tell: no file, a name that is not UTF-8 or has control characters, or
/// more than kMaxSceneBytes of names.
[[nodiscard]] std::string scene_text(const SceneFiles& scene);

/// Parses the JSON. `name`: the stream, for messages. Throws bad_input for a text that scene_text() does not make.
[[nodiscard]] SceneFiles scene_of(const std::string& text, const std::string& name);

}  // namespace bp::detail
