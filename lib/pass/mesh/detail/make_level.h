#pragma once
#include "lib/enclosed/enclosed.h"
#include "lib/pass/mesh/detail/coarse_start.h"
#include "lib/pass/mesh/mesh_params.h"
#include "lib/tighten/tight_proxy.h"

/// Makes one level of detail from the surface that it begins with.
namespace bp {

/// Returns the parameters for simplifying a level to `faces` faces, without limits.
[[nodiscard]] SimplifyParams simplify_params(const StreamHeader& header, const GridFrame& frame,
                                             const MeshParams& params, const PieceMemory& memory, std::uint64_t faces);

/// Returns the mesh of a proxy, and moves its counts into `counts`.
[[nodiscard]] LatticeMesh take(TightProxy&& proxy, LevelCounts& counts);

/// Makes one level from the surface of everything that it must enclose (`dense`), or from a coarse surface around that
/// (`starts`; null: none). `few`: only a number of faces below kFewFaces is asked for. `halfway`: as in tight_proxy().
[[nodiscard]] LatticeMesh make_level(const SurfaceSource& dense, const CoarseStarts* starts, const Enclosed* enclosed,
                                     const SimplifyParams& params, bool few, LatticeMesh* halfway, LevelCounts& counts);

/// Replaces `proxy` by a convex mesh if that is better.
void take_convex(LatticeMesh& proxy, const Enclosed& enclosed, std::uint64_t faces, LevelCounts& counts);

}  // namespace bp
