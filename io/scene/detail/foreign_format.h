#pragma once
#include <cstdint>
#include <string>

namespace bp {

/// What a file is, and which program makes a mesh of it, of formats that people have scenes in and that are not read
/// here: "is a point cloud (LAS), which is not read; ...". By the end of its name, or by its first bytes; empty: not
/// known.
[[nodiscard]] std::string foreign_format(const std::string& path, const std::string& first_bytes = "");

/// The last part of it, also of formats that are read in part (IFC): "convert it: ...".
[[nodiscard]] std::string foreign_way(const std::string& path);

/// Whether the end of a name is that of an archive, in which a scene may be.
[[nodiscard]] bool is_archive(const std::string& path);

/// Throws bad_input with foreign_format(), if that is known.
void refuse_foreign(const std::string& path, const std::string& first_bytes = "");
/// Throws bad_input: a scene of points, or of lines between them, without triangles.
[[noreturn]] void refuse_points(const std::string& name, std::uint64_t points, std::uint64_t lines);

/// Throws bad_input if the first bytes of an IFC file name a schema that is not read.
void refuse_ifc_schema(const std::string& name, const std::string& first_bytes);

}  // namespace bp
