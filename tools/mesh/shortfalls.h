#pragma once
#include <optional>
#include <string>

#include "lib/pass/mesh/mesh_pass.h"
#include "tools/cli/report.h"
#include "tools/mesh/mesh_options.h"

/// Targets of bpmesh that were out of reach: the user gets the best there is, and the reason.
namespace bp {

/// Whether parts and handles may keep the finest level from its faces: a larger scale can help.
[[nodiscard]] bool wants_scale(const MeshOptions& options, const MeshCounts& counts);

/// One note for each target. error_world: bound of --error; 0: none. scale: one that would do (enough_scale()).
void note_shortfalls(Report& report, const MeshOptions& options, const MeshCounts& counts, double error_world,
                     const std::optional<std::string>& scale);

}  // namespace bp
