#pragma once
#include "lib/core/coords.h"

/// The predicates of predicates.h for points with any finite coordinates, from the least double to the largest. They
/// are exact, in integers of some thousand bits, and take tens of microseconds each. Only the few points beyond
/// in_predicate_domain() need them. Templates over points (triangle_intersection.h) accept such points.
namespace bp {

struct WidePoint {
  Vec3d at{};
};

[[nodiscard]] int orient3d(const WidePoint& a, const WidePoint& b, const WidePoint& c, const WidePoint& d);
[[nodiscard]] int orient2d(const WidePoint& a, const WidePoint& b, const WidePoint& c, int axis);

using WideTriangle = std::array<WidePoint, 3>;
[[nodiscard]] inline WideTriangle widened(const TriangleD& t) {
  return {WidePoint{t[0]}, WidePoint{t[1]}, WidePoint{t[2]}};
}

}  // namespace bp
