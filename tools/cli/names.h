#pragma once
#include <string>

#include "lib/core/grid_frame.h"
#include "lib/core/triangle_source.h"
#include "lib/deform/coordinates.h"
#include "lib/grid/stream.h"
#include "lib/pass/mesh/mesh_pass.h"

/// Choices as options, reports and provenance write them; counts as notes do.
namespace bp {

[[nodiscard]] const char* name_of(FillMode fill);
[[nodiscard]] const char* name_of(StructuringElement element);
[[nodiscard]] const char* name_of(MeshMode mode);
[[nodiscard]] const char* name_of(CoordinateKind kind);
/// A path without its folders.
[[nodiscard]] std::string file_name(const std::string& path);
/// "12 degenerate triangles, 1 bad face"; empty if nothing was skipped.
[[nodiscard]] std::string skipped(const SceneCounts& counts);
/// The same, and how far coordinates may be off where they are read in single precision, if that is above a 256th of a
/// voxel; empty if there is nothing to tell.
[[nodiscard]] std::string reading_note(const SceneCounts& counts, double voxel);

}  // namespace bp
