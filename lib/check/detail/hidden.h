#pragma once
#include <array>
#include <string>

#include "lib/check/check_report.h"
#include "lib/check/detail/surface.h"
#include "lib/check/hiding_recipe.h"
#include "lib/core/triangle_source.h"

/// Decides whether a proxy is hidden by a scene once openings narrower than twice a scale are closed.
namespace bp {

struct HiddenReport {
  std::string undecided;           ///< why the question is not decided; empty if it is decided
  std::uint64_t memory_bytes = 0;  ///< memory that deciding takes, if memory is why it is undecided
  std::uint64_t triangles = 0;     ///< triangles of the scene
  double off = 0;                  ///< what their points may be off by, scene units
  Finding exposed;  ///< index: nearby proxy triangle, other: 0, position: the middle of a voxel that is not hidden and
                    /// that the proxy meets
  [[nodiscard]] bool holds() const { return undecided.empty() && exposed.count == 0; }
};

/// Decides whether the solid of the proxy, which must be closed and oriented, lies in the closed cubes of hidden
/// voxels. Exact if all vertices are lattice points of the recipe. Other vertices, as those of a coarser level, are
/// rounded to 2^-16 voxel, and the answer allows for that: it is undecided if a face comes that near to the side of a
/// voxel. If coordinates were rounded when they were read, voxels are grown by as much when they are tested for
/// triangles (fixed_slack()); what is exposed in these voxels, and not in those of the triangles as read, is undecided.
/// `walls`: the scene without its transparent parts; read two or three times from its start. Shared with the tools are
/// the voxels that a triangle touches (lib/voxel), the closing of a tile (lib/closing) and the growth of voxel sets
/// (lib/grid). Memory: some 8 bits for each voxel of the scene's bounds; undecided if that exceeds memory_bytes.
[[nodiscard]] HiddenReport check_hidden(const WeldedMesh& mesh, const Surface& surface, TriangleSource& walls,
                                        const HidingRecipe& recipe, std::size_t max_examples,
                                        std::uint64_t memory_bytes);

/// Returns whether a triangle has a point in the open cube of a voxel, grown by `grow` units on each side. `per_voxel`:
/// units along a voxel's edge. Exact below 2^28.
[[nodiscard]] bool meets_open_voxel(const std::array<LatticeCoord, 3>& triangle, VoxelCoord voxel,
                                    std::int64_t per_voxel = kLatticePerVoxel, std::int64_t grow = 0);

}  // namespace bp
