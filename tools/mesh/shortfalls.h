#pragma once
#include <optional>

#include "lib/pass/mesh/mesh_params.h"
#include "tools/cli/report.h"
#include "tools/mesh/mesh_options.h"

/// Notes on targets of bpmesh that were out of reach: the user gets the best result there is, and the reason.
namespace bp {

/// Facts that the counts do not hold.
struct ShortfallFacts {
  double error_world = 0;              ///< bound of --error; 0: none
  bool has_scale = false;              ///< bpclose --scale closed the stream
  std::optional<double> scene_volume;  ///< volume of the enclosed triangles, if they are closed; scene units cubed
};
/// Adds one note for each target that was not reached.
void note_shortfalls(Report& report, const MeshOptions& options, const MeshCounts& counts, const ShortfallFacts& facts);

}  // namespace bp
