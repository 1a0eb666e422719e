#pragma once
#include "lib/core/coords.h"

namespace bp {

/// Returns true only if every point of one triangle is farther than `distance` from every point of the other, wherever
/// rounding of doubles takes it: planes that many units apart lie between them. May return false for triangles that are
/// farther apart, by up to some times the distance. Triangles without area are segments and points.
[[nodiscard]] bool are_apart(const TriangleD& a, const TriangleD& b, double distance);

}  // namespace bp
