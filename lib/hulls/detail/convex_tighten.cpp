#include "lib/hulls/detail/convex_tighten.h"

#include <algorithm>
#include <optional>

#include "lib/hulls/detail/convex_shape.h"
#include "lib/mesh/box_tree.h"
#include "lib/mesh/constrained_minimum.h"
#include "lib/mesh/lattice_geometry.h"

namespace bp {

namespace {

constexpr int kSweeps = 4;
constexpr double kLeastGain = 1e-3;  // of the volume: sweeps go on if they gain as much
constexpr double kToLattice = 0.9;   // as in convex_steps.cpp
constexpr double kFar = 100;         // of the box: the minimum without constraints lies so far away

/// An edge opposite of a corner, as its face runs, and the normal of the face beyond it.
struct Opposite {
  LatticeCoord a, b;
  Vec3d beyond;
};

std::vector<Opposite> ring_of(const ConvexHull& hull, std::uint32_t v) {
  std::vector<Opposite> ring;
  for (const auto& t : hull.triangles) {
    const auto at = std::find(t.begin(), t.end(), v);
    if (at == t.end()) continue;
    const auto k = std::size_t(at - t.begin());
    const std::uint32_t a = t[(k + 1) % 3], b = t[(k + 2) % 3];
    Opposite side{hull.vertices[a], hull.vertices[b], {}};
    for (const auto& u : hull.triangles) {
      for (std::size_t i = 0; i < 3; ++i) {
        if (u[i] == b && u[(i + 1) % 3] == a)
          side.beyond = to_double(normal_of(hull.vertices[u[0]], hull.vertices[u[1]], hull.vertices[u[2]]));
      }
    }
    ring.push_back(side);
  }
  return ring;
}

/// Adds n . x >= n . p, with room for rounding. It adds nothing if n is no direction.
void add_plane(const Vec3d& n, const LatticeCoord& p, std::vector<PlaneConstraint>& planes) {
  const double size = length(n);
  if (size < 0.5) return;
  const Vec3d unit = (1 / size) * n;
  planes.push_back({unit, dot(unit, to_double(p)) + kToLattice});
}

/// Returns the place that corner v of the hull should move to, if there is one.
std::optional<LatticeCoord> best_place(const ConvexHull& hull, std::uint32_t v, std::span<const LatticeCoord> points) {
  const LatticeCoord base = hull.vertices[v];
  const LatticeBox box = box_of(hull.vertices);
  std::vector<PlaneConstraint> planes;
  Vec3d growth{};  // of six times the volume, along each axis
  for (const Opposite& side : ring_of(hull, v)) {
    const LatticeCoord a = side.a - base, b = side.b - base;
    const Vec3d area = to_double(normal_of({0, 0, 0}, a, b));
    for (std::size_t i = 0; i < 3; ++i) growth[i] += area[i];
    add_plane((-1.0) * side.beyond, a, planes);
    for (const LatticeCoord& q : hull.vertices) {
      if (q != base) add_plane(to_double(normal_of(a, b, q - base)), a, planes);
    }
    for (const LatticeCoord& q : points) add_plane(to_double(normal_of(a, b, q - base)), a, planes);
  }
  Quadric volume;
  volume.xx = volume.yy = volume.zz = length(growth) / (2 * kFar * length(to_double(box.max - box.min)));
  volume.bx = growth[0] / 2, volume.by = growth[1] / 2, volume.bz = growth[2] / 2;
  const std::optional<Vec3d> x = constrained_minimum(volume, {0, 0, 0}, planes);
  if (!x) return {};
  const LatticeCoord to = base + rounded(*x);
  if (to == base || !box.holds({to, to})) return {};
  return to;
}

/// Returns true if the corner has moved.
bool move_corner(ConvexHull& hull, std::uint32_t v, std::span<const LatticeCoord> points) {
  const std::optional<LatticeCoord> to = best_place(hull, v, points);
  if (!to) return false;
  std::vector<LatticeCoord> corners = hull.vertices;
  corners[v] = *to;
  std::optional<ConvexHull> moved = hull_of(corners);
  if (!moved || volume6_of(*moved) >= volume6_of(hull) || !holds_all(*moved, points)) return false;
  draw_diagonals(*moved);
  if (slivers_of(*moved) > slivers_of(hull)) return false;
  hull = std::move(*moved);
  return true;
}

}  // namespace

ConvexHull tightened(ConvexHull hull, std::span<const LatticeCoord> points) {
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    const double before6 = volume6_of(hull);
    const std::vector<LatticeCoord> corners = hull.vertices;  // a move puts them into another order
    for (const LatticeCoord& corner : corners) {
      const auto v = std::find(hull.vertices.begin(), hull.vertices.end(), corner);
      if (v != hull.vertices.end()) move_corner(hull, std::uint32_t(v - hull.vertices.begin()), points);
    }
    if (volume6_of(hull) > (1 - kLeastGain) * before6) break;
  }
  return hull;
}

bool holds_all(const ConvexHull& hull, std::span<const LatticeCoord> points) {
  for (const auto& t : hull.triangles) {
    const LatticeCoord a = hull.vertices[t[0]], normal = normal_of(a, hull.vertices[t[1]], hull.vertices[t[2]]);
    for (const LatticeCoord& p : points) {
      if (side_along(normal, p - a) > 0) return false;
    }
  }
  return true;
}

}  // namespace bp
