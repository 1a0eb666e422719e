#include "lib/hulls/outward_hull.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "lib/hulls/detail/convex_shape.h"
#include "lib/hulls/hull_sides.h"
#include "lib/mesh/box_tree.h"
#include "lib/mesh/constrained_minimum.h"
#include "lib/mesh/lattice_geometry.h"

namespace bp {

namespace {

constexpr double kOff = 1.0 / 16;  // lattice units: far more than points are off by computing
/// Room for rounding to the lattice, tried in this order. Sides along the axes need none; 0.9 is enough for all.
constexpr std::array kRoom{1e-4, 0.3, 0.6, 0.9};

/// The point lies strictly within, also where it is off.
LatticeBox cell_around(const Vec3d& p, double off) {
  LatticeBox cell;
  for (int k = 0; k < 3; ++k) {
    const double x = p[std::size_t(k)];
    cell.min[k] = std::int64_t(std::floor(x - off)), cell.max[k] = std::int64_t(std::ceil(x + off));
  }
  return cell;
}

int128 along(const LatticeCoord& n, const LatticeCoord& d) {
  return int128(n.x) * d.x + int128(n.y) * d.y + int128(n.z) * d.z;
}

/// The inner side of a plane holds all cells: normal . (p - base) <= reach.
struct Halfspace {
  LatticeCoord normal;
  int128 reach;
};

std::vector<Halfspace> halfspaces_of(const ConvexHull& hull, const std::vector<LatticeBox>& cells) {
  const LatticeCoord base = hull.vertices[0];
  std::vector<Halfspace> sides;
  for (const auto& [a, b, c] : hull.triangles) {
    const LatticeCoord normal = normal_of(hull.vertices[a], hull.vertices[b], hull.vertices[c]);
    int128 reach = along(normal, hull.vertices[a] - base);
    for (const LatticeBox& cell : cells) reach = std::max(reach, along(normal, farthest_of(cell, normal) - base));
    sides.push_back({normal, reach});
  }
  return sides;
}

/// A lattice point on the outer sides of `sides`, near all of them; nothing if none is found.
std::optional<LatticeCoord> point_beyond_sides(const std::vector<const Halfspace*>& sides, const LatticeCoord& base,
                                               const LatticeCoord& v) {
  for (const double room : kRoom) {
    Quadric squares;
    std::vector<PlaneConstraint> planes;
    for (const Halfspace* side : sides) {
      const double size = length(to_double(side->normal));
      const Vec3d n = (1 / size) * to_double(side->normal);
      const double d = double(side->reach - along(side->normal, v - base)) / size + room;
      squares.add_plane(n, -d, 1);
      planes.push_back({n, d});
    }
    const std::optional<Vec3d> x = constrained_minimum(squares, {0, 0, 0}, planes);
    if (!x) continue;
    const LatticeCoord p = v + rounded(*x);
    if (std::all_of(sides.begin(), sides.end(),
                    [&](const Halfspace* side) { return along(side->normal, p - base) >= side->reach; }))
      return p;
  }
  return {};
}

/// The hull with a corner beyond the moved sides in the place of each corner: it contains whatever lies within all
/// sides, since in each direction some corner of `hull` is the farthest, and the direction is a sum of the normals
/// there. Nothing if a corner has no such place near the hull.
std::optional<ConvexHull> moved_out(const ConvexHull& hull, const std::vector<LatticeBox>& cells) {
  constexpr double kNear = 0.05;  // of the longest side: how far corners may go
  constexpr std::int64_t kLeastRoom = 16;
  const std::vector<Halfspace> sides = halfspaces_of(hull, cells);
  std::vector<std::vector<const Halfspace*>> around(hull.vertices.size());
  for (std::size_t f = 0; f < sides.size(); ++f) {
    for (const std::uint32_t v : hull.triangles[f]) around[v].push_back(&sides[f]);
  }
  const LatticeBox box = box_of(hull.vertices);
  const LatticeCoord size = box.max - box.min;
  const LatticeBox room =
      box.grown(std::max(kLeastRoom, std::int64_t(kNear * double(std::max({size.x, size.y, size.z})))));
  std::vector<LatticeCoord> corners;
  for (std::size_t v = 0; v < hull.vertices.size(); ++v) {
    const std::optional<LatticeCoord> p = point_beyond_sides(around[v], hull.vertices[0], hull.vertices[v]);
    if (!p || !room.holds({*p, *p})) return {};
    corners.push_back(*p);
  }
  return hull_of(corners);
}

bool holds_cells(const ConvexHull& hull, const std::vector<LatticeBox>& cells) {
  const HullSides sides(hull);
  return std::all_of(cells.begin(), cells.end(), [&](const LatticeBox& cell) { return sides.hold(cell); });
}

ConvexHull hull_of_cells(const std::vector<LatticeBox>& cells) {
  std::vector<LatticeCoord> points;
  for (const LatticeBox& cell : cells) add_corners(cell, points);
  return *hull_of(points);
}

}  // namespace

ConvexHull outward_hull(std::span<const Vec3d> points, double off) {
  std::vector<LatticeBox> cells;
  std::vector<LatticeCoord> near;
  for (const Vec3d& p : points) cells.push_back(cell_around(p, kOff + off)), near.push_back(rounded(p));
  std::optional<ConvexHull> hull = hull_of(near);
  if (hull) hull = moved_out(*hull, cells);
  if (!hull || !holds_cells(*hull, cells)) hull = hull_of_cells(cells);
  draw_diagonals(*hull);
  return std::move(*hull);
}

}  // namespace bp
