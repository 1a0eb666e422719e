#pragma once
#include "lib/enclosed/enclosed.h"
#include "lib/pass/mesh/detail/coarse_start.h"
#include "lib/pass/mesh/mesh_pass.h"
#include "lib/tighten/tight_proxy.h"

/// One level of detail, from the surface that it begins with.
namespace bp {

/// What a level of so many faces is simplified by, without limits.
[[nodiscard]] SimplifyParams simplify_params(const StreamHeader& header, const GridFrame& frame,
                                             const MeshParams& params, const PieceMemory& memory, std::uint64_t faces);

/// Returns the mesh of a proxy; `counts` get what it counted.
[[nodiscard]] LatticeMesh take(TightProxy&& proxy, LevelCounts& counts);

/// One level, from the surface of all that it must enclose, or a coarse one around it. `few`: nothing but a number of
/// faces below kFewFaces matters. `halfway`: as tight_proxy() has it.
[[nodiscard]] LatticeMesh make_level(const SurfaceSource& dense, const CoarseStarts* starts, const Enclosed* enclosed,
                                     const SimplifyParams& params, bool few, LatticeMesh* halfway, LevelCounts& counts);

/// Puts a convex mesh in place of `proxy` where that is better.
void take_convex(LatticeMesh& proxy, const Enclosed& enclosed, std::uint64_t faces, LevelCounts& counts);

}  // namespace bp
