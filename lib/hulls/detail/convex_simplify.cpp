#include "lib/hulls/detail/convex_simplify.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>

#include "lib/hulls/detail/convex_steps.h"
#include "lib/mesh/box_tree.h"
#include "lib/mesh/lattice_geometry.h"

namespace bp {

namespace {

/// Returns a hull of the corners of a coarser lattice's cells around each corner. It is the last resort; the coarsest
/// is a box.
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

/// Returns the nearest point such that `v` lies between it and another corner, so that `v` is no corner any more.
/// Unlike a point beyond the planes it always exists, also for hulls a few lattice units thin.
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

}  // namespace

ConvexHull with_fewer_corners(ConvexHull hull, std::size_t most, double growth) {
  double left6 = growth * volume6_of(hull);
  const LatticeBox room = room_around(hull, kNearBox);
  while (hull.vertices.size() > 4) {
    const HullSteps steps(hull, room);
    std::vector<LatticeCoord> points = hull.vertices;
    std::vector<char> taken(hull.vertices.size(), 0);
    const std::size_t before = hull.vertices.size();
    const std::vector<HullStep> sorted = steps.all();
    // Steps that are taken in any case, a few at a time.
    const std::size_t cheap = before > most ? 1 + sorted.size() / 16 : 0;
    for (std::size_t i = 0; i < sorted.size(); ++i) {
      const HullStep& step = sorted[i];
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

// This ends, with no corner at the place of another. A corner that was taken is within the hull from then on, or
// between two others, and never a corner again. The taken places are finitely many.
void set_corners_apart(std::vector<ConvexHull>& hulls) {
  std::set<LatticeCoord> taken;
  for (ConvexHull& hull : hulls) {
    for (;;) {
      const auto shared = std::find_if(hull.vertices.begin(), hull.vertices.end(),
                                       [&](const LatticeCoord& v) { return taken.count(v) != 0; });
      if (shared == hull.vertices.end()) break;
      const LatticeCoord corner = *shared;
      const auto beyond =
          HullSteps(hull, room_around(hull, kNearBox)).point_beyond(std::uint32_t(shared - hull.vertices.begin()));
      ConvexHull next = with_point(hull, beyond ? *beyond : point_behind(hull, corner));
      if (is_corner(next, corner)) next = with_point(hull, point_behind(hull, corner));
      hull = std::move(next);
    }
    taken.insert(hull.vertices.begin(), hull.vertices.end());
  }
}

}  // namespace bp
