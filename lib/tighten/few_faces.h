#pragma once
#include "lib/tighten/tight_proxy.h"

/// Proxies of so few faces that the order of collapses decides more than their number.
namespace bp {

/// Proxies of fewer faces come from one sequence.
constexpr std::uint64_t kFewFaces = 64;

/// Removes faces one by one from kFewFaces to 4 and keeps each proxy on the way. Returns the one of least volume with
/// at most params.faces faces, fewer than kFewFaces. The sequence does not depend on params.faces, so more faces never
/// make the result larger. Each proxy follows from the one before, or, of a scene in one piece, from its convex hull if
/// that leaves less. If the sequence ends above params.faces, since parts are kept, the result has more. Cost: up to
/// fifty times tight_proxy(), on a surface of some hundred faces.
[[nodiscard]] LatticeMesh tight_proxy_of_few(const SurfaceSource& dense, const Enclosed& enclosed,
                                             const SimplifyParams& params, SimplifyCounts& simplified,
                                             TightenCounts& tightened);

}  // namespace bp
