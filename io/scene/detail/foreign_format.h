#pragma once
#include <cstdint>
#include <string>

namespace bp {

/// Returns what a file is and which program can make a mesh of it: "is a point cloud (LAS), which is not read; ...". It
/// knows the formats of scenes that this suite does not read, by the end of the name or by the first bytes. Returns an
/// empty text for other formats.
[[nodiscard]] std::string foreign_format(const std::string& path, const std::string& first_bytes = "");

/// Returns the last part of that text, also for formats that are read in part (IFC): "convert it: ...".
[[nodiscard]] std::string foreign_way(const std::string& path);

/// Returns whether the end of a name is that of an archive, which may hold a scene.
[[nodiscard]] bool is_archive(const std::string& path);

/// Throws bad_input with foreign_format(), if the format is known.
void refuse_foreign(const std::string& path, const std::string& first_bytes = "");
/// Throws bad_input for a scene of points, or of lines between them, without triangles.
[[noreturn]] void refuse_points(const std::string& name, std::uint64_t points, std::uint64_t lines);

/// Throws bad_input if the first bytes of an IFC file name a schema that is not read.
void refuse_ifc_schema(const std::string& name, const std::string& first_bytes);

}  // namespace bp
