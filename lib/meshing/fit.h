#pragma once
#include <functional>

#include "lib/meshing/simplify.h"

/// Fitting: levels of detail that need not enclose ([CB17] §5.4). The closing has merged parts and closed holes; its
/// surface is simplified freely and drawn onto the input, so that neither steps nor the half voxel that voxels stand
/// out remain. Every step is checked by the guard: the result is closed, 2-manifold and embedded.
namespace bp {

/// Where a vertex at `p` should be, given the unit normal of the surface there; lattice units.
using FitTarget = std::function<LatticeCoord(const LatticeCoord& p, const Vec3d& normal)>;

/// `dense`, the surface of repaired voxels, freely simplified to some ten times `faces` (at least 20,000), each vertex
/// then drawn to its target, as far as the surface stays embedded. The start of every level. Deterministic.
[[nodiscard]] LatticeMesh fine_fit(const SurfaceSource& dense, std::uint64_t faces, const FitTarget& target,
                                   const PieceMemory& memory = {});

/// A level: `fine` freely simplified with the targets of `params`.
[[nodiscard]] LatticeMesh fit_level(const LatticeMesh& fine, const SimplifyParams& params, SimplifyCounts& counts);

/// Moves each vertex of an embedded mesh to its target, or half or a quarter of the way; a move that would let faces
/// meet, turn over or become needles is not made. Returns the number of moves.
std::uint64_t draw_to_targets(HalfEdgeMesh& mesh, const FitTarget& target, int sweeps);

}  // namespace bp
