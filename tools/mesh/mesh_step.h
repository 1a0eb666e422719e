#pragma once
#include <optional>
#include <string>
#include <vector>

#include "io/mesh/mesh_writer.h"
#include "lib/core/triangle_source.h"
#include "lib/pass/mesh/mesh_pass.h"
#include "tools/cli/report.h"
#include "tools/mesh/mesh_options.h"

/// The last step of the pipe, as bpmesh and libbp do it.
namespace bp {

/// Returns the targets of the options, without what is enclosed.
[[nodiscard]] MeshParams mesh_params(const MeshOptions& options, const StreamHeader& header);

/// Sets what is enclosed, and returns its name. A note tells if it is less than possible. `scene`: the scene's
/// triangles, if they are not in files that the header names; null: they are.
[[nodiscard]] std::string set_enclosure(const MeshOptions& options, BrickSource& source, MeshParams& params,
                                        const PassContext& context, TriangleSource* scene, Report& report);

/// Returns the volume that the triangles go around, scene units cubed; nothing if there are none.
[[nodiscard]] std::optional<double> volume_of(const std::vector<TriangleD>& scene);

/// The facts that all levels of a run share.
struct MeshedStream {
  const StreamHeader& header;
  std::string checksum;  ///< checksum of the stream
  const std::string& enclosed;
};
/// Appends an entry about this meshing step to the provenance of each level.
void tell_steps(std::vector<LatticeMesh>& levels, const MeshOptions& options, const MeshedStream& from);

/// Returns how a proxy of this mode is written.
[[nodiscard]] MeshWriteOptions write_options(MeshMode mode, const Vec3d& origin);

/// Returns the part of --memory that bpmesh has for surfaces.
[[nodiscard]] PieceMemory mesh_memory(const CommonOptions& common);

}  // namespace bp
