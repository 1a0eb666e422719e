#include "lib/enclosed/face_target.h"

namespace bp {

// Tests the regions of the plane around the triangle, one corner or edge after the other ([Eri04] 5.1.5).
double squared_distance(const Vec3d& p, const std::array<Vec3d, 3>& t) {
  const Vec3d ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0];
  const auto from = [&](const Vec3d& q) {
    const Vec3d d = p - q;
    return dot(d, d);
  };
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return dot(ap, ap);
  const Vec3d bp = p - t[1];
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return dot(bp, bp);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return from(t[0] + (d1 / (d1 - d3)) * ab);
  const Vec3d cp = p - t[2];
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return dot(cp, cp);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return from(t[0] + (d2 / (d2 - d6)) * ac);
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
    return from(t[1] + ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (t[2] - t[1]));
  const Vec3d n = cross(ab, ac);
  const double s = dot(n, ap), nn = dot(n, n);
  return nn > 0 ? s * s / nn : dot(ap, ap);
}

FaceTarget::FaceTarget(const std::array<Vec3d, 3>& corners) : corners_(corners) {
  const auto plane = [](const Vec3d& n, const Vec3d& through) -> Plane {
    const double size = length(n);
    if (!(size > 0)) return {{}, -1};  // all points lie beyond
    const Vec3d unit = (1 / size) * n;
    return {unit, dot(unit, through)};
  };
  const Vec3d normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
  planes_[3] = plane(normal, corners[0]);
  for (std::size_t k = 0; k < 3; ++k) planes_[k] = plane(cross(corners[(k + 1) % 3] - corners[k], normal), corners[k]);
}

double FaceTarget::squared_distance(const Vec3d& p) const {
  const bool over = planes_[0].height(p) <= 0 && planes_[1].height(p) <= 0 && planes_[2].height(p) <= 0;
  const double above = planes_[3].height(p);
  return over ? above * above : bp::squared_distance(p, corners_);
}

}  // namespace bp
