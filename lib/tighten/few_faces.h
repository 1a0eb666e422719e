#pragma once
#include "lib/tighten/tight_proxy.h"

/// Proxies of so few faces that the order of collapses decides more than their number.
namespace bp {

/// Returns the proxy of least volume with at most params.faces faces, which are fewer than kFewFaces. It comes from one
/// sequence of proxies, which begins at kFewFaces whatever params.faces is: the next one has four faces fewer, or two
/// below 40. So more faces do not make the result larger, as a rule: the sequence ends where proxies hold clearly more
/// than the least that params.faces allow, or where parts and handles leave no fewer faces. The next proxy is the least
/// of several. Some follow from the one before. At a few numbers of faces, and in a jam, one follows from the first
/// surface. Of a scene in one piece, one follows from the convex hull of the first proxy. Where the sequence ends above
/// params.faces, the result is its last proxy or that of tight_proxy(): the one with fewer faces, or the smaller one.
/// Cost: some fifty times tight_proxy() on a surface of some hundred faces.
[[nodiscard]] TightProxy tight_proxy_of_few(const SurfaceSource& dense, const Enclosed& enclosed,
                                            const SimplifyParams& params);

}  // namespace bp
