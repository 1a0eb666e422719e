#include "lib/meshing/convex_simplify.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include "lib/meshing/box_tree.h"
#include "lib/meshing/constrained_minimum.h"
#include "lib/meshing/lattice_geometry.h"

namespace bp {

namespace {

/// An edge, and the point that would take its place.
struct Step {
  std::uint32_t a, b;
  LatticeCoord point;
  double cost6;  // six times the volume between the hull and the point
};

class Steps {
 public:
  explicit Steps(const ConvexHull& hull) : hull_(hull), near_(box_of(hull.vertices)), around_(hull.vertices.size()) {
    const LatticeCoord size = near_.max - near_.min;
    near_ = {near_.min - size, near_.max + size};
    for (std::uint32_t f = 0; f < hull.triangles.size(); ++f) {
      const auto& t = hull.triangles[f];
      normals_.push_back(to_double(normal_of(hull.vertices[t[0]], hull.vertices[t[1]], hull.vertices[t[2]])));
      for (const std::uint32_t v : t) around_[v].push_back(f);
    }
  }

  /// One for each edge that has one, cheapest first.
  [[nodiscard]] std::vector<Step> all() const {
    std::vector<Step> steps;
    for (const auto& t : hull_.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = t[k], b = t[(k + 1) % 3];
        if (a > b) continue;
        if (const auto point = point_beyond(a, b)) steps.push_back({a, b, *point, volume6_to(*point)});
      }
    }
    std::stable_sort(steps.begin(), steps.end(), [](const Step& x, const Step& y) { return x.cost6 < y.cost6; });
    return steps;
  }

  /// A place that may take that of a corner alone.
  [[nodiscard]] std::optional<LatticeCoord> point_beyond(std::uint32_t v) const { return point_beyond(v, v); }

  /// Corners of the faces around both ends of the edge: another step there would be for another hull.
  [[nodiscard]] std::vector<std::uint32_t> reach(const Step& step) const {
    std::vector<std::uint32_t> corners;
    for (const std::uint32_t v : {step.a, step.b}) {
      for (const std::uint32_t f : around_[v])
        corners.insert(corners.end(), hull_.triangles[f].begin(), hull_.triangles[f].end());
    }
    return corners;
  }

 private:
  /// Beyond the planes of all faces around the edge, and near them.
  [[nodiscard]] std::optional<LatticeCoord> point_beyond(std::uint32_t a, std::uint32_t b) const {
    constexpr double kToLattice = 0.9;  // rounding to the lattice moves a point by half the diagonal of a cube, 0.87
    const LatticeCoord base = hull_.vertices[a];
    Quadric quadric;
    std::vector<PlaneConstraint> planes;
    for (const std::uint32_t v : {a, b}) {
      for (const std::uint32_t f : around_[v]) {
        const double area2 = length(normals_[f]);
        const Vec3d n = (1 / area2) * normals_[f];
        const double d = dot(n, to_double(hull_.vertices[v] - base));
        quadric.add_plane(n, -d, area2);
        planes.push_back({n, d + kToLattice});
      }
    }
    const Vec3d middle = 0.5 * to_double(hull_.vertices[b] - base);
    const std::optional<Vec3d> x = constrained_minimum(quadric, middle, planes);
    if (!x) return {};
    const LatticeCoord point = base + rounded(*x);
    if (!near_.holds({point, point})) return {};
    return point;
  }

  [[nodiscard]] double volume6_to(const LatticeCoord& p) const {
    double sum = 0;
    for (std::size_t f = 0; f < normals_.size(); ++f)
      sum += std::max(0.0, dot(normals_[f], to_double(p - hull_.vertices[hull_.triangles[f][0]])));
    return sum;
  }

  const ConvexHull& hull_;
  LatticeBox near_;  // beyond it lie solutions of nearly singular systems
  std::vector<Vec3d> normals_;
  std::vector<std::vector<std::uint32_t>> around_;  // per vertex: its faces
};

/// The corners of cells of a coarser lattice around each corner: for what has no cheaper way. At the coarsest, a box.
ConvexHull snapped(const ConvexHull& hull, std::size_t most) {
  const LatticeBox box = box_of(hull.vertices);
  for (std::int64_t cell = 2;; cell *= 2) {
    std::vector<LatticeCoord> points;
    for (const LatticeCoord& v : hull.vertices) {
      for (int i = 0; i < 8; ++i) {
        LatticeCoord p;
        for (int k = 0; k < 3; ++k) {
          const std::int64_t low = floor_div(v[k] - box.min[k], cell), high = ceil_div(v[k] - box.min[k], cell);
          p[k] = std::min(box.min[k] + cell * ((i >> k & 1) != 0 ? high : low), box.max[k]);
        }
        points.push_back(p);
      }
    }
    ConvexHull coarse = *hull_of(points);
    if (coarse.vertices.size() <= most) return coarse;
  }
}

/// The nearest point such that `v` lies between it and another corner, so that v is none any more. Unlike a point
/// beyond the planes there always is one, also of hulls a few lattice units thin.
LatticeCoord point_behind(const ConvexHull& hull, const LatticeCoord& v) {
  LatticeCoord best{};
  double least = std::numeric_limits<double>::infinity();
  for (const LatticeCoord& other : hull.vertices) {
    if (other == v) continue;
    LatticeCoord step = v - other;
    const std::int64_t parts = std::gcd(std::gcd(step.x, step.y), step.z);
    for (int k = 0; k < 3; ++k) step[k] /= parts;
    const Vec3d s = to_double(step);
    if (dot(s, s) < least) least = dot(s, s), best = v + step;
  }
  return best;
}

bool is_corner(const ConvexHull& hull, const LatticeCoord& v) {
  return std::find(hull.vertices.begin(), hull.vertices.end(), v) != hull.vertices.end();
}

ConvexHull with_point(const ConvexHull& hull, const LatticeCoord& point) {
  std::vector<LatticeCoord> points = hull.vertices;
  points.push_back(point);
  return *hull_of(points);
}

}  // namespace

ConvexHull with_fewer_corners(ConvexHull hull, std::size_t most, double growth) {
  double left6 = growth * volume6_of(hull);
  while (hull.vertices.size() > 4) {
    const Steps steps(hull);
    std::vector<LatticeCoord> points = hull.vertices;
    std::vector<char> taken(hull.vertices.size(), 0);
    const std::size_t before = hull.vertices.size();
    const std::vector<Step> sorted = steps.all();
    const std::size_t cheap = before > most ? 1 + sorted.size() / 16 : 0;  // taken in any case, few at a time
    for (std::size_t i = 0; i < sorted.size(); ++i) {
      const Step& step = sorted[i];
      if (step.cost6 > left6 && i >= cheap) break;
      const std::vector<std::uint32_t> reach = steps.reach(step);
      if (std::any_of(reach.begin(), reach.end(), [&](std::uint32_t v) { return taken[v] != 0; })) continue;
      for (const std::uint32_t v : reach) taken[v] = 1;
      left6 -= step.cost6;
      points.push_back(step.point);
    }
    if (points.size() == before) break;
    ConvexHull next = *hull_of(points);
    if (next.vertices.size() >= before) break;
    hull = std::move(next);
  }
  return hull.vertices.size() > most ? snapped(hull, most) : hull;
}

// Ends, and with no corner at a place of another: a corner that was taken is within the hull from then on, or between
// two others, and never a corner again, and places taken are finitely many.
void set_corners_apart(std::vector<ConvexHull>& hulls) {
  std::set<LatticeCoord> taken;
  for (ConvexHull& hull : hulls) {
    for (;;) {
      const auto shared = std::find_if(hull.vertices.begin(), hull.vertices.end(),
                                       [&](const LatticeCoord& v) { return taken.count(v) != 0; });
      if (shared == hull.vertices.end()) break;
      const LatticeCoord corner = *shared;
      const auto beyond = Steps(hull).point_beyond(std::uint32_t(shared - hull.vertices.begin()));
      ConvexHull next = with_point(hull, beyond ? *beyond : point_behind(hull, corner));
      if (is_corner(next, corner)) next = with_point(hull, point_behind(hull, corner));
      hull = std::move(next);
    }
    taken.insert(hull.vertices.begin(), hull.vertices.end());
  }
}

}  // namespace bp
