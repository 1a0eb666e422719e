#pragma once
#include <string>

#include "lib/core/grid_frame.h"
#include "lib/core/triangle_source.h"
#include "lib/deform/coordinates.h"
#include "lib/grid/stream.h"
#include "lib/pass/mesh/mesh_params.h"

/// Names of choices as options, reports and provenance write them; texts for counts, as in notes.
namespace bp {

[[nodiscard]] const char* name_of(FillMode fill);
[[nodiscard]] const char* name_of(StructuringElement element);
[[nodiscard]] const char* name_of(MeshMode mode);
[[nodiscard]] const char* name_of(CoordinateKind kind);
/// Returns a path without its folders.
[[nodiscard]] std::string file_name(const std::string& path);
/// Returns "12 degenerate triangles, 1 bad face"; empty if nothing was skipped.
[[nodiscard]] std::string skipped(const SceneCounts& counts);
/// As skipped(). If coordinates are read in single precision and may be off by more than a 256th of a voxel, that is
/// added. Empty if there is nothing to tell.
[[nodiscard]] std::string reading_note(const SceneCounts& counts, double voxel);

}  // namespace bp
