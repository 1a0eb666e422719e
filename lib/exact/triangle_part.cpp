#include "lib/exact/triangle_part.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lib/exact/triangle_intersection.h"

namespace bp {

namespace {

constexpr double kCellGrowth = 1e-9;        // of a cell, as a share of its edges
constexpr double kPointRounding = 0x1p-50;  // of a point in doubles, as a share of its coordinates
constexpr double kNear = 1e-12;             // of a point in doubles, as a share of the cell's edges

/// The determinant of orient3d() and a bound of its error (lib/exact/predicates.h, "Filter").
struct Side {
  double value, error;
};
Side side_of(const TriangleD& t, const Vec3d& p) {
  Vec3d u, v, w;
  for (std::size_t i = 0; i < 3; ++i) u[i] = t[1][i] - t[0][i], v[i] = t[2][i] - t[0][i], w[i] = p[i] - t[0][i];
  double value = 0, permanent = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    const double l = u[j] * v[k], r = u[k] * v[j];
    value += (l - r) * w[i];
    permanent += (std::abs(l) + std::abs(r)) * std::abs(w[i]);
  }
  return {std::abs(value), 16 * 0x1p-53 * permanent};
}

/// The convex hull of boxes, relative to a corner of the cell.
using Hull = std::vector<Bounds3d>;

/// Adds bounds of the place where segment pq, which meets triangle t, crosses the plane of t. They follow from the
/// ratio of the distances of its ends. If pq lies in the plane, it adds all of pq.
void add_crossing(const Vec3d& p, const Vec3d& q, const TriangleD& t, const Vec3d& corner, Hull& hull) {
  const Side a = side_of(t, p), b = side_of(t, q);
  const double a_lo = std::max(a.value - a.error, 0.0), a_hi = a.value + a.error;
  const double b_lo = std::max(b.value - b.error, 0.0), b_hi = b.value + b.error;
  const double lo = a_lo + b_hi > 0 ? a_lo / (a_lo + b_hi) * (1 - 1e-15) : 0;
  const double hi = a_hi + b_lo > 0 ? std::min(a_hi / (a_hi + b_lo) * (1 + 1e-15), 1.0) : 1;
  for (const double s : {lo, hi}) {
    Bounds3d& box = hull.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      const double x = p[i] + s * (q[i] - p[i]) - corner[i], error = 0x1p-50 * (std::abs(p[i]) + std::abs(q[i]));
      box.min[i] = x - error, box.max[i] = x + error;
    }
  }
}

void add_crossings(const TriangleD& a, const TriangleD& b, const Vec3d& corner, Hull& hull) {
  for (std::size_t e = 0; e < 3; ++e) {
    if (segment_meets_triangle(a[e], a[(e + 1) % 3], b.data())) {
      add_crossing(a[e], a[(e + 1) % 3], b, corner, hull);
    }
  }
}

/// Returns the least and the largest value of x·a on a box, or a bit beyond.
std::array<double, 2> extent(const Bounds3d& box, const Vec3d& a) {
  double lo = 0, hi = 0, sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double x = box.min[i] * a[i], y = box.max[i] * a[i];
    lo += std::min(x, y), hi += std::max(x, y);
    sum += std::abs(x) + std::abs(y);
  }
  return {lo - 0x1p-50 * sum, hi + 0x1p-50 * sum};
}

bool separated(const Hull& hull, const Bounds3d& box, const Vec3d& axis) {
  const auto [lo, hi] = extent(box, axis);
  bool below = true, above = true;
  for (const Bounds3d& part : hull) {
    const auto [a, b] = extent(part, axis);
    below = below && b < lo, above = above && a > hi;
  }
  return below || above;
}

/// Returns true unless an axis surely separates the hull from the box. For every segment that misses the box there is
/// one: an axis of the box, or an axis across the segment and an axis of the box.
bool may_meet(const Hull& hull, const Bounds3d& box) {
  if (hull.empty()) return true;
  for (std::size_t i = 0; i < 3; ++i) {
    Vec3d axis{};
    axis[i] = 1;
    if (separated(hull, box, axis)) return false;
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    for (auto p = hull.begin(); p != hull.end(); ++p) {
      for (auto q = hull.begin(); q != p; ++q) {
        Vec3d across{};
        across[j] = p->min[k] - q->min[k], across[k] = q->min[j] - p->min[j];
        if (separated(hull, box, across)) return false;
      }
    }
  }
  return true;
}

double largest(const Vec3d& p) {
  return std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
}

}  // namespace

bool may_meet_within(const TriangleD& a, const TriangleD& b, const Bounds3d& box) {
  Hull hull;
  add_crossings(a, b, box.min, hull);
  add_crossings(b, a, box.min, hull);
  Bounds3d here;
  for (std::size_t i = 0; i < 3; ++i) here.min[i] = 0, here.max[i] = (box.max[i] - box.min[i]) * (1 + 0x1p-50);
  return may_meet(hull, here);
}

double rounding_of(const Bounds3d& cell, const TriangleD& t) {
  double most = std::max(largest(cell.min), largest(cell.max));
  for (const Vec3d& p : t) most = std::max(most, largest(p));
  return std::max(kNear * cell.longest_side(), kPointRounding * most);
}

double growth_for(const Bounds3d& cell, const TriangleD& t) {
  return std::max(kCellGrowth * cell.longest_side(), 16 * rounding_of(cell, t));
}

Bounds3d grown(const Bounds3d& box, double by) {
  Bounds3d out = box;
  for (std::size_t i = 0; i < 3; ++i) out.min[i] -= by, out.max[i] += by;
  return out;
}

bool lies_in(const Bounds3d& inner, const Bounds3d& outer) {
  bool in = true;
  for (std::size_t i = 0; i < 3; ++i) in = in && inner.min[i] >= outer.min[i] && inner.max[i] <= outer.max[i];
  return in;
}

template <class Height>
void TrianglePart::cut(const Height& height) {
  std::vector<Vec3d> kept;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const Vec3d &p = points_[k], &q = points_[(k + 1) % points_.size()];
    const double hp = height(p), hq = height(q);
    if (hp >= 0) kept.push_back(p);
    if ((hp >= 0) == (hq >= 0)) continue;
    const double s = hp / (hp - hq);
    kept.push_back({p[0] + s * (q[0] - p[0]), p[1] + s * (q[1] - p[1]), p[2] + s * (q[2] - p[2])});
  }
  points_ = std::move(kept);
}

TrianglePart::TrianglePart(const TriangleD& t, const Bounds3d& box) {
  Vec3d size;
  for (std::size_t i = 0; i < 3; ++i) size[i] = box.max[i] - box.min[i];
  for (const Vec3d& p : t) points_.push_back({p[0] - box.min[0], p[1] - box.min[1], p[2] - box.min[2]});
  for (std::size_t i = 0; i < 3 && !points_.empty(); ++i) {
    cut([&](const Vec3d& p) { return p[i]; });
    cut([&](const Vec3d& p) { return size[i] - p[i]; });
  }
  origin_ = box.min;
}

std::vector<Vec3d> TrianglePart::corners() const {
  std::vector<Vec3d> all;
  for (const Vec3d& p : points_) all.push_back(at(p));
  return all;
}

Vec3d TrianglePart::relative_middle() const {
  Vec3d middle{};
  for (const Vec3d& p : points_)
    for (std::size_t i = 0; i < 3; ++i) middle[i] += p[i] / double(points_.size());
  return middle;
}

Vec3d TrianglePart::middle() const {
  return at(relative_middle());
}

std::vector<Vec3d> TrianglePart::points_within() const {
  if (empty()) return {};
  const Vec3d middle = relative_middle();
  std::vector<Vec3d> all{at(middle)};
  for (const Vec3d& p : points_)
    all.push_back(at({(p[0] + middle[0]) / 2, (p[1] + middle[1]) / 2, (p[2] + middle[2]) / 2}));
  return all;
}

}  // namespace bp
