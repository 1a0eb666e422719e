#include "lib/hulls/detail/convex_steps.h"

#include <algorithm>
#include <cmath>

#include "lib/mesh/lattice_geometry.h"

namespace bp {

HullSteps::HullSteps(const ConvexHull& hull, const LatticeBox& room)
    : hull_(hull), room_(room), around_(hull.vertices.size()) {
  for (std::uint32_t f = 0; f < hull.triangles.size(); ++f) {
    const auto& t = hull.triangles[f];
    normals_.push_back(to_double(normal_of(hull.vertices[t[0]], hull.vertices[t[1]], hull.vertices[t[2]])));
    for (const std::uint32_t v : t) around_[v].push_back(f);
  }
}

std::vector<HullStep> HullSteps::all() const {
  std::vector<HullStep> steps;
  for (const auto& t : hull_.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      if (a > b) continue;
      if (const auto point = point_beyond(a, b)) steps.push_back({a, b, *point, volume6_to(*point)});
    }
  }
  std::stable_sort(steps.begin(), steps.end(), [](const HullStep& x, const HullStep& y) { return x.cost6 < y.cost6; });
  return steps;
}

std::optional<LatticeCoord> HullSteps::point_beyond(std::uint32_t v) const {
  return point_beyond(v, v);
}

std::vector<std::uint32_t> HullSteps::reach(const HullStep& step) const {
  std::vector<std::uint32_t> corners;
  for (const std::uint32_t v : {step.a, step.b}) {
    for (const std::uint32_t f : around_[v])
      corners.insert(corners.end(), hull_.triangles[f].begin(), hull_.triangles[f].end());
  }
  return corners;
}

std::optional<LatticeCoord> HullSteps::point_for(const Quadric& quadric, const std::vector<PlaneConstraint>& planes,
                                                 const LatticeCoord& base, const LatticeCoord& other) const {
  const Vec3d middle = 0.5 * to_double(other - base);
  const std::optional<Vec3d> x = constrained_minimum(quadric, middle, planes);
  if (!x) return {};
  const LatticeCoord point = base + rounded(*x);
  if (!room_.holds({point, point})) return {};
  return point;
}

/// Returns a point beyond the planes of all faces around the edge, within the room and near the planes: by the squares
/// of distances, or by the volume, which is linear. Rounding may make either the better one.
std::optional<LatticeCoord> HullSteps::point_beyond(std::uint32_t a, std::uint32_t b) const {
  // Rounding to the lattice moves a point by up to half the diagonal of a cube, 0.87.
  constexpr double kToLattice = 0.9;
  constexpr double kSquares = 1e-6;  // of volume: squares decide only where the volume leaves it open
  const LatticeCoord base = hull_.vertices[a], other = hull_.vertices[b];
  Quadric squares;
  Vec3d area{};
  std::vector<PlaneConstraint> planes;
  for (const std::uint32_t v : {a, b}) {
    for (const std::uint32_t f : around_[v]) {
      const double area2 = length(normals_[f]);
      const Vec3d n = (1 / area2) * normals_[f];
      const double d = dot(n, to_double(hull_.vertices[v] - base));
      squares.add_plane(n, -d, area2);
      planes.push_back({n, d + kToLattice});
      for (std::size_t i = 0; i < 3; ++i) area[i] += normals_[f][i];
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    Vec3d up{}, down{};
    up[i] = 1, down[i] = -1;
    planes.push_back({up, double(room_.min[int(i)] - base[int(i)]) + 0.5});
    planes.push_back({down, double(base[int(i)] - room_.max[int(i)]) + 0.5});
  }
  const std::optional<LatticeCoord> near = point_for(squares, planes, base, other);
  if (a == b) return near;
  Quadric volume = squares;
  for (double* x : {&volume.xx, &volume.xy, &volume.xz, &volume.yy, &volume.yz, &volume.zz}) *x *= kSquares;
  volume.bx = kSquares * squares.bx + area[0];
  volume.by = kSquares * squares.by + area[1];
  volume.bz = kSquares * squares.bz + area[2];
  const std::optional<LatticeCoord> least = point_for(volume, planes, base, other);
  if (!near || !least) return near ? near : least;
  return volume6_to(*least) < volume6_to(*near) ? least : near;
}

double HullSteps::volume6_to(const LatticeCoord& p) const {
  double sum = 0;
  for (std::size_t f = 0; f < normals_.size(); ++f)
    sum += std::max(0.0, dot(normals_[f], to_double(p - hull_.vertices[hull_.triangles[f][0]])));
  return sum;
}

LatticeBox room_around(const ConvexHull& hull, double share) {
  const LatticeBox box = box_of(hull.vertices);
  const LatticeCoord size = box.max - box.min;
  return box.grown(std::int64_t(std::ceil(share * double(std::max({size.x, size.y, size.z})))));
}

ConvexHull with_point(const ConvexHull& hull, const LatticeCoord& point) {
  std::vector<LatticeCoord> points = hull.vertices;
  points.push_back(point);
  return *hull_of(points);
}

}  // namespace bp
