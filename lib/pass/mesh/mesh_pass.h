#pragma once
#include <memory>
#include <vector>

#include "lib/grid/stream.h"
#include "lib/pass/context.h"
#include "lib/pass/mesh/mesh_params.h"

/// The last pass of the pipe (bpmesh): reads bricks and makes proxies.
namespace bp {

/// Makes the proxies, finest first: one for each number in params.faces, or one. `params` is passed by value, since the
/// scene's triangles are moved out of it. Meshes the closing layer; the solid layer if the stream has no closing.
/// Throws bad_input if that layer is empty or not the one that the mode needs, bad_argument if the targets contradict
/// each other, and out_of_resource if context.pieces do not suffice for the surface. The surface is never whole in
/// memory unless limits or distances need it.
[[nodiscard]] std::vector<LatticeMesh> mesh_stream(BrickSource& source, const PassContext& context, MeshParams params,
                                                   MeshCounts& counts);

/// Returns the limit on memory at which mesh_stream() has enough; 0: not known. `triangles`: number of the scene's
/// triangles, which need not be in `params`. It reads the stream and takes the memory of some bricks. Call it after a
/// refusal: a step that is refused knows only its own memory, and the next step might be refused in the next run.
[[nodiscard]] std::uint64_t mesh_limit(BrickSource& source, const PassContext& context, const MeshParams& params,
                                       std::uint64_t triangles);

}  // namespace bp
