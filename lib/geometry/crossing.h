#pragma once
#include "lib/exact/wide_predicates.h"

/// Winding numbers by counting crossings.
namespace bp {

/// Signed crossing of triangle t with the ray from p upwards: +1 where the ray leaves through a face turned upwards, -1
/// downwards, else 0. Exact within the domain of the predicates. Summed over a closed, oriented surface that p does not
/// lie on, it is the winding number around p.
///
/// To have no special cases, p is moved by (e, e^2, 0) with e infinitesimal: the ray then passes no edge and no
/// vertical triangle, and since the signs are antisymmetric in the ends of an edge, exactly one of two triangles on
/// either side of an edge is hit.
[[nodiscard]] int crossing_above(const TriangleD& t, const Vec3d& p);
/// The same, exact for any finite coordinates.
[[nodiscard]] int crossing_above(const WideTriangle& t, const WidePoint& p);

}  // namespace bp
