#pragma once
#include <string>

/// Names of the formats that scenes are read in: extensions in lower case, without a dot.
namespace bp {

/// What the name of a file tells; empty if its extension is none of a format that is read. "-" tells nothing.
[[nodiscard]] std::string scene_format_of(const std::string& path);

/// A format by the name that a person gives it (`.PLY`, `ply`). Throws bad_argument if there is none of that name.
[[nodiscard]] std::string scene_format_named(const std::string& name);

}  // namespace bp
