#pragma once
#include <array>
#include <vector>

// Intersection of two triangles with small integer corners, by clipping in exact rational arithmetic. Knows nothing of
// orientation predicates: the definition that lib/exact/triangle_intersection.h is compared with.
namespace bp::reference {

using Point = std::array<long, 3>;
using Triangle = std::array<Point, 3>;

/// A point (x, y, z) / w with w > 0 in lowest terms.
struct RationalPoint {
  long x, y, z, w;
  friend bool operator==(const RationalPoint&, const RationalPoint&) = default;
};

/// Corners of the convex figure a ∩ b (a polygon, a segment, a point or nothing), possibly repeated.
[[nodiscard]] std::vector<RationalPoint> intersection(const Triangle& a, const Triangle& b);

[[nodiscard]] bool is_point(const RationalPoint& p, const Point& q);
[[nodiscard]] bool on_segment(const RationalPoint& p, const Point& u, const Point& v);
[[nodiscard]] bool zero_area(const Triangle& t);

}  // namespace bp::reference
