#pragma once
#include <string>

#include "lib/grid/stream.h"

/// The scene files that a brick stream tells of (docs/brick-stream.md, section 4), as JSON.
namespace bp::detail {

/// Empty if there are none to tell of: no file, a name that is not UTF-8 or has control characters, or more than
/// kMaxSceneBytes of names.
[[nodiscard]] std::string scene_text(const SceneFiles& scene);

/// `name`: of the stream, for messages. Throws bad_input if the text is none that scene_text() makes.
[[nodiscard]] SceneFiles scene_of(const std::string& text, const std::string& name);

}  // namespace bp::detail
