#pragma once
#include "lib/tighten/tight_proxy.h"

/// Proxies of so few faces that the order of collapses decides more than their number.
namespace bp {

/// Below so many, one way leads through all numbers of faces.
constexpr std::uint64_t kFewFaces = 64;
/// SimplifyCounts::limit where clearly fewer faces than were wanted have least volume.
constexpr const char* kLeastVolume = "least-volume";

/// The tight proxy of least volume with at most params.faces faces, fewer than kFewFaces, that the way from kFewFaces
/// down to 4 comes past. So more faces never make it larger, and it may have fewer than it might. The way is the same
/// whatever is wanted: each proxy follows from the one before, or, of a scene in one piece, from its convex hull if
/// that leaves less. Where the way ends before params.faces, parts being kept, the result has more. Cost:
/// up to fifty times tight_proxy(), on the surface of some hundred faces that it begins with.
[[nodiscard]] LatticeMesh tight_proxy_of_few(const SurfaceSource& dense, const Enclosed& enclosed,
                                             const SimplifyParams& params, SimplifyCounts& simplified,
                                             TightenCounts& tightened);

}  // namespace bp
