#include "lib/geometry/crossing.h"

#include "lib/exact/predicates.h"

namespace bp {

namespace {

const Vec3d& place(const Vec3d& p) {
  return p;
}
const Vec3d& place(const WidePoint& p) {
  return p.at;
}

/// Returns the side of the line from a to b, seen from above, on which the infinitesimally moved p lies. It is 0 only
/// if a and b coincide in plan.
template <class P>
int side_in_plan(const P& a, const P& b, const P& p) {
  if (const int s = orient2d(a, b, p, 2); s != 0) return s;
  const double ay = place(a)[1], by = place(b)[1];
  if (ay != by) return ay > by ? 1 : -1;  // the derivative of the determinant by x is a.y - b.y
  // The derivative by y is b.x - a.x; the difference of distinct doubles is not 0.
  return sign_of(place(b)[0] - place(a)[0]);
}

template <class P>
int crossing(const std::array<P, 3>& t, const P& p) {
  const int facing = orient2d(t[0], t[1], t[2], 2);
  if (facing == 0) return 0;
  for (std::size_t e = 0; e < 3; ++e)
    if (side_in_plan(t[e], t[(e + 1) % 3], p) != facing) return 0;
  return orient3d(t[0], t[1], t[2], p) == -facing ? facing : 0;  // p lies below the plane
}

}  // namespace

int crossing_above(const TriangleD& t, const Vec3d& p) {
  return crossing(t, p);
}

int crossing_above(const WideTriangle& t, const WidePoint& p) {
  return crossing(t, p);
}

}  // namespace bp
