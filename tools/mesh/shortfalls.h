#pragma once
#include <optional>

#include "lib/pass/mesh/mesh_pass.h"
#include "tools/cli/report.h"
#include "tools/mesh/mesh_options.h"

/// Targets of bpmesh that were out of reach: the user gets the best there is, and the reason.
namespace bp {

/// What is known beside the counts.
struct ShortfallFacts {
  double error_world = 0;              ///< bound of --error; 0: none
  bool has_scale = false;              ///< bpclose --scale closed the stream
  std::optional<double> scene_volume;  ///< of triangles that are enclosed, if they are closed; scene units cubed
};
/// One note for each target.
void note_shortfalls(Report& report, const MeshOptions& options, const MeshCounts& counts, const ShortfallFacts& facts);

}  // namespace bp
