#pragma once
#include <span>

#include "lib/fit/fit_place.h"
#include "lib/mesh/half_edge_mesh.h"
#include "lib/simplify/simplify.h"

/// The last step of a fit: vertices move to where the mesh is nearest to the points of the scene, in the least squares
/// sense ([HDD93]). Three actions take turns: points are assigned to faces, edges are flipped, vertices are moved. A
/// face most of whose points lie in one plane is held to that plane.
namespace bp {

/// `points`: lattice units, spread evenly over the surface that is wanted; some tens per face. Every move is checked:
/// an embedded mesh stays embedded, edge limit, limits and reach of `params` are kept, and no face turns over or
/// becomes a needle. Cost: `rounds` searches per point, parallel; the result does not depend on the number of threads.
/// Returns the number of moves.
std::uint64_t settle(HalfEdgeMesh& mesh, std::span<const FitPlace> points, const SimplifyParams& params, int rounds);

}  // namespace bp
