#pragma once
#include "lib/core/grid_frame.h"
#include "lib/grid/stream.h"
#include "lib/stage/mesh_stage.h"

/// Choices as options, reports and provenance write them.
namespace bp {

[[nodiscard]] const char* name_of(FillMode fill);
[[nodiscard]] const char* name_of(StructuringElement element);
[[nodiscard]] const char* name_of(UpAxis up);
[[nodiscard]] const char* name_of(MeshMode mode);

}  // namespace bp
