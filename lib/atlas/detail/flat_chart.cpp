#include "lib/atlas/detail/flat_chart.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "lib/core/vec3.h"

namespace bp {

namespace {

using Point = std::array<double, 2>;
using Flat = std::array<Point, 3>;

constexpr double kFacingCosine = 0.25;  // between a face's normal and that of the plane

double cross2(const Point& o, const Point& a, const Point& b) {
  return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
}

/// Returns whether a line along an edge of `a` has `b` on its other side, up to `slack`.
bool is_beside(const Flat& a, const Flat& b, double slack) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Point &p = a[k], &q = a[(k + 1) % 3];
    const double l = std::hypot(q[0] - p[0], q[1] - p[1]);
    if (!(l > 0)) return true;
    if (cross2(p, q, b[0]) <= slack * l && cross2(p, q, b[1]) <= slack * l && cross2(p, q, b[2]) <= slack * l)
      return true;
  }
  return false;
}

/// Triangles in a plane, found by squares of a grid.
class FlatFaces {
 public:
  FlatFaces(double square, double slack) : square_(square), slack_(slack) {}
  /// Adds a triangle. If it overlaps another one, it is not added, and the result is false.
  bool add(const Flat& t) {
    std::vector<std::uint64_t> squares;
    Point lo = t[0], hi = t[0];
    for (const Point& p : t) {
      for (std::size_t i = 0; i < 2; ++i) lo[i] = std::min(lo[i], p[i]), hi[i] = std::max(hi[i], p[i]);
    }
    for (auto x = step(lo[0]); x <= step(hi[0]); ++x) {
      for (auto y = step(lo[1]); y <= step(hi[1]); ++y)
        squares.push_back(std::uint64_t(std::uint32_t(x)) << 32 | std::uint32_t(y));
    }
    for (const std::uint64_t s : squares) {
      const auto found = in_square_.find(s);
      if (found == in_square_.end()) continue;
      for (const std::uint32_t other : found->second) {
        if (!is_beside(t, faces_[other], slack_) && !is_beside(faces_[other], t, slack_)) return false;
      }
    }
    for (const std::uint64_t s : squares) in_square_[s].push_back(std::uint32_t(faces_.size()));
    faces_.push_back(t);
    return true;
  }

 private:
  [[nodiscard]] std::int64_t step(double x) const { return std::int64_t(std::floor(x / square_)); }
  double square_, slack_;
  std::vector<Flat> faces_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> in_square_;
};

/// Returns the convex hull, counter-clockwise (Andrew's monotone chain).
std::vector<Point> hull_of(std::vector<Point> points) {
  std::sort(points.begin(), points.end());
  std::vector<Point> hull;
  const auto half = [&](auto begin, auto end) {
    const std::size_t base = hull.size();
    for (auto p = begin; p != end; ++p) {
      while (hull.size() >= base + 2 && cross2(hull[hull.size() - 2], hull.back(), *p) <= 0) hull.pop_back();
      hull.push_back(*p);
    }
    hull.pop_back();
  };
  half(points.begin(), points.end());
  half(points.rbegin(), points.rend());
  return hull;
}

struct Turn {
  double c = 1, s = 0;  // cosine and sine
  [[nodiscard]] Point operator()(const Point& p) const { return {c * p[0] + s * p[1], c * p[1] - s * p[0]}; }
};

void bounds(const std::vector<Point>& points, const Turn& turn, Point& lo, Point& hi) {
  lo = {HUGE_VAL, HUGE_VAL};
  hi = {-HUGE_VAL, -HUGE_VAL};
  for (const Point& p : points) {
    const Point q = turn(p);
    for (std::size_t i = 0; i < 2; ++i) lo[i] = std::min(lo[i], q[i]), hi[i] = std::max(hi[i], q[i]);
  }
}

/// Returns the turn after which the upright rectangle around `points` is smallest, and lies along x. One of its sides
/// lies along a side of their hull.
Turn smallest_rectangle(const std::vector<Point>& points) {
  constexpr std::size_t kMostSides = 256;
  const std::vector<Point> hull = hull_of(points);
  Turn best;
  double least = HUGE_VAL;
  const std::size_t stride = hull.size() / kMostSides + 1;
  for (std::size_t k = 0; k < hull.size(); k += stride) {
    const Point &p = hull[k], &q = hull[(k + 1) % hull.size()];
    const double l = std::hypot(q[0] - p[0], q[1] - p[1]);
    if (!(l > 0)) continue;
    Turn turn{(q[0] - p[0]) / l, (q[1] - p[1]) / l};
    Point lo, hi;
    bounds(hull, turn, lo, hi);
    const double area = (hi[0] - lo[0]) * (hi[1] - lo[1]);
    if (!(area < least * (1 - 1e-9))) continue;
    least = area;
    best = hi[0] - lo[0] >= hi[1] - lo[1] ? turn : Turn{-turn.s, turn.c};
  }
  return best;
}

/// Lays the corners into their smallest rectangle.
void straighten(Chart& chart) {
  std::vector<Point> points;
  points.reserve(3 * chart.corners.size());
  for (const Flat& t : chart.corners) points.insert(points.end(), t.begin(), t.end());
  const Turn turn = smallest_rectangle(points);
  Point lo, hi;
  bounds(points, turn, lo, hi);
  for (Flat& t : chart.corners) {
    for (Point& p : t) {
      p = turn(p);
      p = {p[0] - lo[0], p[1] - lo[1]};
    }
  }
  chart.size = {hi[0] - lo[0], hi[1] - lo[1]};
}

/// Returns two directions across `n`.
std::array<Vec3d, 2> across(const Vec3d& n) {
  const std::size_t least = std::size_t(
      std::min_element(n.begin(), n.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }) - n.begin());
  Vec3d e{};
  e[least] = 1;
  Vec3d u = cross(e, n);
  u = (1 / length(u)) * u;
  return {u, cross(n, u)};
}

}  // namespace

Chart flat_chart(const LatticeMesh& mesh, const FaceRegions& regions, std::vector<std::uint32_t> faces,
                 std::vector<std::uint32_t>& left) {
  const Vec3d direction = regions.direction(faces);
  const auto [u, v] = across(direction);
  const LatticeCoord middle = mesh.vertices[mesh.triangles[faces.front()][0]];
  std::vector<Flat> flat;
  flat.reserve(faces.size());
  double sides = 0, reach = 0;
  for (const std::uint32_t f : faces) {
    Flat& t = flat.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const LatticeCoord d = mesh.vertices[mesh.triangles[f][k]] - middle;
      const Vec3d p{double(d.x), double(d.y), double(d.z)};
      t[k] = {dot(p, u), dot(p, v)};
      reach = std::max({reach, std::abs(t[k][0]), std::abs(t[k][1])});
    }
    sides += std::hypot(t[1][0] - t[0][0], t[1][1] - t[0][1]) + std::hypot(t[2][0] - t[0][0], t[2][1] - t[0][1]);
  }
  FlatFaces laid(std::max({sides / double(2 * faces.size()), reach / 4096, 1e-3}), 1e-9 * reach + 1e-6);
  Chart chart;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const Vec3d& n = regions.normal(faces[i]);
    const bool faces_up = dot(n, direction) >= kFacingCosine || n == Vec3d{};
    if (!chart.faces.empty() && (!faces_up || !laid.add(flat[i]))) {
      left.push_back(faces[i]);
      continue;
    }
    if (chart.faces.empty()) (void)laid.add(flat[i]);
    chart.faces.push_back(faces[i]);
    chart.corners.push_back(flat[i]);
  }
  straighten(chart);
  return chart;
}

}  // namespace bp
