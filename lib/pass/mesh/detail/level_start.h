#pragma once
#include "lib/pass/mesh/detail/ground.h"
#include "lib/pass/mesh/detail/level_inputs.h"

/// The voxels of a stream, and the surface that its first level begins with.
namespace bp {

/// Reads the voxels of a stream, and repairs them if proxies lie around them. Throws as mesh_stream() does.
[[nodiscard]] Shelves read_voxels(BrickSource& source, const ShelfFactory& make_shelf, const MeshParams& params,
                                  MeshCounts& counts);

/// Makes the surface that the first level begins with. In mode inside it counts what is not part of it.
[[nodiscard]] Start make_start(const LevelInputs& in, const PieceMemory& memory, const Shelves& shelves,
                               MeshCounts& counts);

}  // namespace bp
