#pragma once
#include <string>

#include "lib/pass/mesh/mesh_params.h"
#include "tools/cli/report.h"
#include "tools/mesh/mesh_options.h"
#include "tools/run/provenance.h"

/// The facts about a run of bpmesh that go to its output files and to --report.
namespace bp {

/// Returns the provenance of a level. enclosed: the set that stayed inside; input: checksum of the stream.
[[nodiscard]] Provenance mesh_provenance(const MeshOptions& options, const GridFrame& frame,
                                         const std::string& enclosed, const std::string& input, std::size_t level);

void fill_report(Report& report, const MeshOptions& options, const MeshCounts& counts);

}  // namespace bp
