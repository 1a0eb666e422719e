#pragma once
#include <span>

#include "lib/fit/fit_place.h"
#include "lib/mesh/edge_limit.h"
#include "lib/mesh/step_limits.h"

/// The last step of a fit: vertices settle where the surface is nearest to points of what it stands for, in the least
/// squares sense ([HDD93]). By turns points are assigned to faces, edges flipped and vertices moved. A face most of
/// whose points lie in one plane is held to that plane.
namespace bp {

/// `points`: lattice units, spread evenly over the surface that is wanted; some tens per face. Every move is checked:
/// an embedded mesh stays embedded, `edge_limit` (may be empty) and `limits` (may be null) are kept, and no face turns
/// over or becomes a needle. Cost: `rounds` searches per point, parallel; the result does not depend on the number of
/// threads. Returns the number of moves.
std::uint64_t settle(HalfEdgeMesh& mesh, std::span<const FitPlace> points, const EdgeLimit& edge_limit,
                     StepLimits* limits, int rounds);

}  // namespace bp
