#pragma once
#include "lib/core/vec3.h"

/// Parts of triangles, in floating point, which searches for distances cut triangles into.
namespace bp {

[[nodiscard]] double length_squared(const Vec3d& a, const Vec3d& b);
[[nodiscard]] Vec3d centre_of(const TriangleD& t);
/// Returns the square of the largest distance from `c` to a corner.
[[nodiscard]] double radius_squared(const TriangleD& t, const Vec3d& c);
/// Returns the corner opposite the longest edge.
[[nodiscard]] std::size_t apex_of(const TriangleD& t);
/// Cuts a triangle into halves, across its longest edge.
[[nodiscard]] std::array<TriangleD, 2> halves(const TriangleD& t);

/// A convex polygon, up to rounding: the rest of a triangle after at most three cuts.
struct Polygon {
  std::array<Vec3d, 9> corners;  // 6 without rounding; each cut adds at most half as many corners as there are edges
  std::size_t count = 0;

  Polygon() = default;
  explicit Polygon(const TriangleD& t) : corners{t[0], t[1], t[2]}, count(3) {}
  void add(const Vec3d& p) { corners[count++] = p; }
  /// Returns the number of triangles of its fan.
  [[nodiscard]] std::size_t triangles() const { return count < 3 ? 0 : count - 2; }
  [[nodiscard]] TriangleD triangle(std::size_t i) const { return {corners[0], corners[i + 1], corners[i + 2]}; }
  [[nodiscard]] double area() const;
};

/// The parts of a polygon on either side of a plane. Both have the points where the plane cuts.
struct CutPolygon {
  Polygon inside, outside;
};

/// Cuts a polygon. A point is inside if dot(inwards, p - through) >= -margin.
[[nodiscard]] CutPolygon cut(const Polygon& polygon, const Vec3d& through, const Vec3d& inwards, double margin = 0);

}  // namespace bp
