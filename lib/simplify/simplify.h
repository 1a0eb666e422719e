#pragma once
#include "lib/mesh/lattice_mesh.h"
#include "lib/simplify/simplify_params.h"
#include "lib/surface/surface.h"

/// Bounding simplification: quadric edge collapses [GH97] that grow the solid ([SGG00], [DLCW11]; [CB17] §3.4) or, if
/// an enclosed set is given, only keep that set inside. Each collapse is checked exactly, so the result encloses the
/// input surface, or the enclosed set, and does not intersect itself (docs/bounding.md).
namespace bp {

/// Simplifies the dense surface of repaired voxels: by cells, in parallel, down to a few times the wanted faces
/// (surface_tree.h), then in strict order. Deterministic, the same for every number of threads and every memory. Cost:
/// about n log n in its triangles. Throws out_of_resource if params.memory does not suffice, `failed` if the surface is
/// not closed and manifold or spans 2^29 lattice units.
[[nodiscard]] LatticeMesh simplify(const SurfaceSource& dense, const SimplifyParams& params, SimplifyCounts& counts);

/// Simplifies a mesh: with params.dense a dense_surface, else any mesh that is closed, oriented, 2-manifold and
/// embedded.
[[nodiscard]] LatticeMesh simplify(const LatticeMesh& mesh, const SimplifyParams& params, SimplifyCounts& counts);

/// Simplifies a mesh that is not dense and approximates other planes than its own: `quadrics`, per vertex and relative
/// to it.
[[nodiscard]] LatticeMesh simplify(const LatticeMesh& mesh, const std::vector<Quadric>& quadrics,
                                   const SimplifyParams& params, SimplifyCounts& counts);

}  // namespace bp
