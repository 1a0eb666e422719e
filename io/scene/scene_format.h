#pragma once
#include <string>

/// Names of the formats that scenes are read in: extensions in lower case, without a dot.
namespace bp {

/// Returns the format that the name of a file tells; empty if no format that is read has its extension. "-" tells
/// nothing.
[[nodiscard]] std::string scene_format_of(const std::string& path);

/// Returns the format for a name as people write it (`.PLY`, `ply`). Throws bad_argument if there is none.
[[nodiscard]] std::string scene_format_named(const std::string& name);

/// Returns true if the reader of a format tells names of parts (io/scene/part_names.h).
[[nodiscard]] bool names_parts(const std::string& format);

}  // namespace bp
