#include "lib/geometry/crossing.h"

#include "lib/core/predicates.h"

namespace bp {

namespace {

/// Side of the infinitesimally moved p of the line from a to b, seen from above; 0 only if a and b coincide in plan.
int side_in_plan(const Vec3d& a, const Vec3d& b, const Vec3d& p) {
  if (const int s = orient2d(a, b, p, 2); s != 0) return s;
  if (a[1] != b[1]) return a[1] > b[1] ? 1 : -1;  // d/dx of the determinant is a.y - b.y
  return sign_of(b[0] - a[0]);                    // d/dy is b.x - a.x; the difference of distinct doubles is not 0
}

}  // namespace

int crossing_above(const TriangleD& t, const Vec3d& p) {
  const int facing = orient2d(t[0], t[1], t[2], 2);
  if (facing == 0) return 0;
  for (std::size_t e = 0; e < 3; ++e)
    if (side_in_plan(t[e], t[(e + 1) % 3], p) != facing) return 0;
  return orient3d(t[0], t[1], t[2], p) == -facing ? facing : 0;  // p below the plane
}

}  // namespace bp
