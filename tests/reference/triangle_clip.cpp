#include "tests/reference/triangle_clip.h"

#include <algorithm>
#include <cstdlib>
#include <numeric>

namespace bp::reference {

namespace {

__extension__ typedef __int128 wide;

wide gcd(wide a, wide b) {
  if (a < 0) a = -a;
  if (b < 0) b = -b;
  while (b != 0) {
    const wide r = a % b;
    a = b;
    b = r;
  }
  return a;
}

Point minus(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Closed half-space n . p >= n . o; the value is scaled by w > 0.
struct HalfSpace {
  Point n, o;
  [[nodiscard]] wide operator()(const RationalPoint& p) const {
    return wide(n[0]) * (p.x - wide(o[0]) * p.w) + wide(n[1]) * (p.y - wide(o[1]) * p.w) +
           wide(n[2]) * (p.z - wide(o[2]) * p.w);
  }
};

/// Where the segment pq passes the plane; f(p) and f(q) have opposite signs.
RationalPoint crossing(const HalfSpace& f, const RationalPoint& p, const RationalPoint& q) {
  const wide fp = f(p), fq = f(q);  // each scaled by its w
  std::array<wide, 4> c = {fq * p.x - fp * q.x, fq * p.y - fp * q.y, fq * p.z - fp * q.z, fq * p.w - fp * q.w};
  wide g = 0;
  for (const wide v : c) g = gcd(g, v);
  if (c[3] < 0) g = -g;
  return {long(c[0] / g), long(c[1] / g), long(c[2] / g), long(c[3] / g)};
}

std::vector<RationalPoint> clip(const std::vector<RationalPoint>& polygon, const HalfSpace& f) {
  std::vector<RationalPoint> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const RationalPoint &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const wide fp = f(p), fq = f(q);
    if (fp >= 0) kept.push_back(p);
    if ((fp > 0 && fq < 0) || (fp < 0 && fq > 0)) kept.push_back(crossing(f, p, q));
  }
  return kept;
}

}  // namespace

std::vector<RationalPoint> intersection(const Triangle& a, const Triangle& b) {
  std::vector<RationalPoint> figure;
  for (const Point& p : a) figure.push_back({p[0], p[1], p[2], 1});
  const Point n = cross(minus(b[1], b[0]), minus(b[2], b[0]));
  figure = clip(figure, {n, b[0]});
  figure = clip(figure, {{-n[0], -n[1], -n[2]}, b[0]});
  for (std::size_t e = 0; e < 3; ++e) figure = clip(figure, {cross(n, minus(b[(e + 1) % 3], b[e])), b[e]});
  return figure;
}

bool is_point(const RationalPoint& p, const Point& q) {
  return p == RationalPoint{q[0], q[1], q[2], 1};
}

bool on_segment(const RationalPoint& p, const Point& u, const Point& v) {
  const Point d = minus(v, u);
  const Point r = {p.x - u[0] * p.w, p.y - u[1] * p.w, p.z - u[2] * p.w};  // w (p - u)
  if (cross(d, r) != Point{0, 0, 0}) return false;
  const long along = d[0] * r[0] + d[1] * r[1] + d[2] * r[2];
  return along >= 0 && along <= p.w * (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
}

bool zero_area(const Triangle& t) {
  return cross(minus(t[1], t[0]), minus(t[2], t[0])) == Point{0, 0, 0};
}

}  // namespace bp::reference
