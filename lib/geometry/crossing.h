#pragma once
#include "lib/exact/wide_predicates.h"

/// Winding numbers by counting crossings.
namespace bp {

/// Returns the signed crossing of triangle t with the ray from p upwards: +1 if the ray leaves through a face turned
/// upwards, -1 if downwards, 0 if it misses. Exact within the domain of the predicates. Summed over a closed, oriented
/// surface that p does not lie on, it is the winding number around p.
///
/// To have no special cases, p is moved by (e, e^2, 0) with e infinitesimal. Then the ray passes no edge and no
/// vertical triangle. The signs are antisymmetric in the ends of an edge, so exactly one of two triangles on either
/// side of an edge is hit.
[[nodiscard]] int crossing_above(const TriangleD& t, const Vec3d& p);
/// Returns the same crossing, exact for any finite coordinates.
[[nodiscard]] int crossing_above(const WideTriangle& t, const WidePoint& p);

}  // namespace bp
