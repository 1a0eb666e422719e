#pragma once
#include <array>
#include <string>

#include "lib/check/check_report.h"
#include "lib/check/detail/surface.h"
#include "lib/core/grid_frame.h"
#include "lib/core/triangle_source.h"
#include "lib/grid/stream.h"

/// Is a proxy hidden by a scene, once openings that are narrower than twice a scale are closed?
namespace bp {

/// The voxels and the closing that say what is hidden (docs/bounding.md, "Occluders"). With G the voxels that the scene
/// touches, E their closing:
///   O       what the outside reaches through faces of voxels not in E
///   O'      what it reaches through those not in G, nor behind the closing: not in the complement of E and O
///   T       voxels of G beside O', and those of G beside these; over faces, edges and corners
///   hidden  all others: not in O', not in T
struct HidingRecipe {
  GridFrame frame;
  double scale_world = 0;
  StructuringElement element = StructuringElement::cube;
};

struct HiddenReport {
  std::string undecided;           ///< why it is not; empty: it is
  std::uint64_t memory_bytes = 0;  ///< that deciding it takes, where memory is why it is undecided
  std::uint64_t triangles = 0;     ///< of the scene
  Finding exposed;  ///< index: proxy triangle beside, other: 0, position: the middle of a voxel that is not hidden and
                    ///< that the proxy meets
  [[nodiscard]] bool holds() const { return undecided.empty() && exposed.count == 0; }
};

/// Whether the solid of the proxy, which must be closed and oriented, lies in the closed cubes of hidden voxels. Exact,
/// of vertices that are lattice points of the recipe; of others it is not decided. `walls`: the scene without what can
/// be seen through; read twice from its start. Shares with the tools the voxels that a triangle touches (lib/voxel),
/// the closing of a tile (lib/closing) and how sets of voxels grow (lib/grid). Memory: some 8 bits for each voxel of
/// the scene's bounds; where that is more than memory_bytes, it is not decided.
[[nodiscard]] HiddenReport check_hidden(const WeldedMesh& mesh, const Surface& surface, TriangleSource& walls,
                                        const HidingRecipe& recipe, std::size_t max_examples,
                                        std::uint64_t memory_bytes);

/// Whether a triangle has a point in the open cube of a voxel. Exact, for lattice coordinates below 2^28.
[[nodiscard]] bool meets_open_voxel(const std::array<LatticeCoord, 3>& triangle, VoxelCoord voxel);

}  // namespace bp
