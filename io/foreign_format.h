#pragma once
#include <string>

namespace bp {

/// What a file is, and which program makes a mesh of it, of formats that people have scenes in and that are not read
/// here: "is a point cloud (LAS), which is not read; ...". By the end of its name, or by its first bytes; empty: not
/// known.
[[nodiscard]] std::string foreign_format(const std::string& path, const std::string& first_bytes = "");

/// The last part of it, also of formats that are read in part (IFC): "convert it: ...".
[[nodiscard]] std::string foreign_way(const std::string& path);

/// The remedy for points without faces: "a point cloud needs a surface first; ...".
[[nodiscard]] std::string surface_remedy();

}  // namespace bp
