#include "lib/pass/voxelize/empty_scene.h"

#include "lib/core/error.h"

namespace bp {

void refuse_empty_scene(const std::string& name, const SceneCounts& counts) {
  fail(ErrorCode::bad_input,
       "{}: no triangles ({} degenerate, {} non-finite, {} bad faces skipped); a scene needs at least one with an area",
       name, counts.degenerate, counts.non_finite, counts.bad_faces);
}

}  // namespace bp
