#include "lib/geometry/triangle_parts.h"

#include <algorithm>

namespace bp {

double length_squared(const Vec3d& a, const Vec3d& b) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

Vec3d centre_of(const TriangleD& t) {
  Vec3d c;
  for (std::size_t i = 0; i < 3; ++i) c[i] = t[0][i] / 3 + t[1][i] / 3 + t[2][i] / 3;
  return c;
}

double radius_squared(const TriangleD& t, const Vec3d& c) {
  double radius = 0;
  for (const Vec3d& p : t) radius = std::max(radius, length_squared(p, c));
  return radius;
}

std::size_t apex_of(const TriangleD& t) {
  std::size_t apex = 0;
  double longest = -1;
  for (std::size_t k = 0; k < 3; ++k) {
    const double l = length_squared(t[(k + 1) % 3], t[(k + 2) % 3]);
    if (l > longest) longest = l, apex = k;
  }
  return apex;
}

std::array<TriangleD, 2> halves(const TriangleD& t) {
  const std::size_t k = apex_of(t);
  const Vec3d &apex = t[k], &a = t[(k + 1) % 3], &b = t[(k + 2) % 3];
  Vec3d m;
  for (std::size_t i = 0; i < 3; ++i) m[i] = a[i] / 2 + b[i] / 2;
  return {TriangleD{apex, a, m}, TriangleD{apex, m, b}};
}

double Polygon::area() const {
  double sum = 0;
  for (std::size_t i = 0; i < triangles(); ++i) sum += area_of(triangle(i));
  return sum;
}

CutPolygon cut(const Polygon& polygon, const Vec3d& through, const Vec3d& inwards, double margin) {
  CutPolygon out;
  for (std::size_t k = 0; k < polygon.count; ++k) {
    const Vec3d &a = polygon.corners[k], &b = polygon.corners[(k + 1) % polygon.count];
    const double sa = dot(inwards, a - through) + margin, sb = dot(inwards, b - through) + margin;
    (sa >= 0 ? out.inside : out.outside).add(a);
    if ((sa >= 0) == (sb >= 0)) continue;
    Vec3d crossing;
    for (std::size_t i = 0; i < 3; ++i) crossing[i] = a[i] + sa / (sa - sb) * (b[i] - a[i]);
    out.inside.add(crossing);
    out.outside.add(crossing);
  }
  return out;
}

}  // namespace bp
