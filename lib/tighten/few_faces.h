#pragma once
#include "lib/tighten/tight_proxy.h"

/// Makes proxies of so few faces that the order of collapses decides more than their number.
namespace bp {

/// Returns the proxy of least volume with at most params.faces faces, which must be below kFewFaces. It chooses from
/// one sequence of proxies that begins at kFewFaces for every params.faces: each has four faces fewer than the one
/// before, or two below 40. So more faces rarely make the result larger. The sequence ends when proxies hold clearly
/// more than the least one that params.faces allow, or when parts and handles allow no fewer faces.
///
/// Each proxy of the sequence is the least of several. One follows from the proxy before. For a few numbers of faces,
/// and when the sequence is stuck, one follows from the first surface. If the scene is in one piece, one follows from
/// the convex hull of the first proxy. A proxy inside is one around the complement: the least volume then is the most
/// that it holds, and there is no hull. If the sequence ends above params.faces, the result is its last proxy or that
/// of tight_proxy(): the one with fewer faces, or the smaller one. Cost: about fifty times tight_proxy() on a surface
/// of some hundred faces.
[[nodiscard]] TightProxy tight_proxy_of_few(const SurfaceSource& dense, const Enclosed& enclosed,
                                            const SimplifyParams& params);

}  // namespace bp
