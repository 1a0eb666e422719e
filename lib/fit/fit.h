#pragma once
#include "lib/fit/fit_place.h"
#include "lib/simplify/simplify.h"

/// Fitting: levels of detail that need not enclose ([CB17] §5.4). The closing has merged parts and closed holes; its
/// surface is simplified freely, and its vertices settle where it is nearest to what it stands for (settle.h), so that
/// neither steps nor the half voxel that voxels stand out remain. Every step is checked by the guard: the result is
/// closed, 2-manifold and embedded.
namespace bp {

/// The start of every level.
struct FineFit {
  LatticeMesh surface;
  std::vector<Quadric> quadrics;  ///< per vertex and about it: of the planes at the points
  std::vector<FitPlace> points;   ///< evenly over the dense surface, each at its target
  double point_area = 0;          ///< of the dense surface for each of them, square lattice units
};

/// `dense`, the surface of repaired voxels, freely simplified to some ten times `faces` (at least 20,000), then drawn
/// to the targets as far as the surface stays embedded. `edge_limit`: of the levels; may be empty. Deterministic.
[[nodiscard]] FineFit fine_fit(const SurfaceSource& dense, std::uint64_t faces, const FitTarget& target,
                               const EdgeLimit& edge_limit = {}, const PieceMemory& memory = {});

/// A level: freely simplified with the targets of `params`, which it keeps, and settled. If params.enclosed and
/// params.reach are given, no face leaves that reach, which is loosened where faces jam: planes do not know where the
/// surface ends, so that collapses alone draw spires along them, and take thin parts away.
[[nodiscard]] LatticeMesh fit_level(const FineFit& fine, const SimplifyParams& params, SimplifyCounts& counts);

/// Moves each vertex of an embedded mesh to its target, or half or a quarter of the way, keeping `edge_limit` (may be
/// empty; vertex_mover.h). Returns the number of moves.
std::uint64_t draw_to_targets(HalfEdgeMesh& mesh, const FitTarget& target, const EdgeLimit& edge_limit, int sweeps);

}  // namespace bp
