#pragma once
#include "lib/fit/fit_place.h"
#include "lib/mesh/half_edge_mesh.h"
#include "lib/simplify/simplify.h"

/// Fitting: levels of detail that need not enclose the scene ([CB17] §5.4). The closing has merged parts and closed
/// holes. Its surface is simplified freely, and then its vertices move to where the mesh is nearest to the scene
/// (settle.h), which removes the steps of voxels and the half voxel by which voxels lie outside the scene. Every step
/// is checked by the guard: the result is closed, 2-manifold and embedded.
namespace bp {

/// The finely simplified surface from which every level is made.
struct FineFit {
  LatticeMesh surface;
  std::vector<Quadric> quadrics;  ///< per vertex, relative to it: sum of the planes at the points
  std::vector<FitPlace> points;   ///< evenly over the dense surface, each moved to its target
  double point_area = 0;          ///< area of the dense surface for each point, square lattice units
};

/// Simplifies `dense`, the surface of repaired voxels, freely to some ten times `faces` (at least 20,000), then moves
/// its vertices to their targets as far as the surface stays embedded. `edge_limit`: the limit on edges of the levels;
/// may be empty. Deterministic.
[[nodiscard]] FineFit fine_fit(const SurfaceSource& dense, std::uint64_t faces, const FitTarget& target,
                               const EdgeLimit& edge_limit = {}, const PieceMemory& memory = {});

/// Makes a level: simplifies freely with the limits of `params`, and settles the vertices. If params.enclosed and
/// params.reach are given, no face goes farther from the enclosed set than the reach, which is loosened where nothing
/// can be collapsed any more. Without that bound collapses would draw spires along planes and remove thin parts, since
/// a plane does not tell where the surface ends.
[[nodiscard]] LatticeMesh fit_level(const FineFit& fine, const SimplifyParams& params, SimplifyCounts& counts);

/// Moves each vertex of an embedded mesh to its target, or half or a quarter of the way, keeping `edge_limit` (may be
/// empty; vertex_mover.h). Returns the number of moves.
std::uint64_t draw_to_targets(HalfEdgeMesh& mesh, const FitTarget& target, const EdgeLimit& edge_limit, int sweeps);

}  // namespace bp
