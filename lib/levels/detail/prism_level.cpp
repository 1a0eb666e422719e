#include "lib/levels/detail/prism_level.h"

#include <algorithm>
#include <cmath>

#include "lib/core/vec3.h"
#include "lib/levels/detail/few_faces_level.h"

namespace bp {

namespace {

using Flat = std::array<double, 2>;

/// What a flat scene lies in; lattice units.
struct Slab {
  Vec3d origin{}, a{}, b{}, up{};  // a, b, up: of length 1, at right angles
  double low = 0, high = 0;        // along `up`
  [[nodiscard]] Flat flat(const Vec3d& p) const { return {dot(p - origin, a), dot(p - origin, b)}; }
  [[nodiscard]] Vec3d point(const Flat& p, double height) const { return origin + p[0] * a + p[1] * b + height * up; }
};

/// The one for which f is largest.
template <class F>
Vec3d farthest(const std::vector<Vec3d>& points, const F& f) {
  return *std::max_element(points.begin(), points.end(), [&](const Vec3d& p, const Vec3d& q) { return f(p) < f(q); });
}

/// Through three points that lie far apart.
std::optional<Slab> slab_of(const std::vector<Vec3d>& points) {
  Slab slab;
  slab.origin = farthest(points, [&](const Vec3d& p) { return length(p - points.front()); });
  const Vec3d along = farthest(points, [&](const Vec3d& p) { return length(p - slab.origin); }) - slab.origin;
  const auto off = [&](const Vec3d& p) { return length(cross(along, p - slab.origin)); };
  const Vec3d normal = cross(along, farthest(points, off) - slab.origin);
  if (!(length(normal) > length(along))) return {};  // all in a line
  slab.a = (1 / length(along)) * along;
  slab.up = (1 / length(normal)) * normal;
  slab.b = cross(slab.up, slab.a);
  for (const Vec3d& p : points) {
    const double height = dot(p - slab.origin, slab.up);
    slab.low = std::min(slab.low, height);
    slab.high = std::max(slab.high, height);
  }
  if (slab.high - slab.low > kLatticePerVoxel) return {};
  return slab;
}

/// Twice the area of a triangle; above 0: counterclockwise.
double turn(const Flat& p, const Flat& q, const Flat& r) {
  return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
}

/// Corners of the convex hull, counterclockwise.
std::vector<Flat> hull_of_flat(std::vector<Flat> points) {
  std::sort(points.begin(), points.end());
  std::vector<Flat> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t first = hull.size();
    for (const Flat& p : points) {
      while (hull.size() >= first + 2 && turn(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

/// Without corners that lie as good as on the line of their neighbours.
std::vector<Flat> without_straight(std::vector<Flat> outline) {
  constexpr double kStraight = 0.25;
  for (std::size_t i = 0; i < outline.size() && outline.size() > 3;) {
    const std::size_t n = outline.size();
    const Flat &p = outline[(i + n - 1) % n], &r = outline[(i + 1) % n];
    if (turn(p, outline[i], r) > kStraight * std::hypot(r[0] - p[0], r[1] - p[1])) {
      ++i;
    } else {
      outline.erase(outline.begin() + std::ptrdiff_t(i));
    }
  }
  return outline;
}

/// Every edge moved outwards by `room`; nothing of a needle.
std::vector<Flat> grown(const std::vector<Flat>& outline, double room) {
  constexpr double kNeedle = 1e-3;  // a corner of 3.6 degrees moves 32 times as far
  const std::size_t n = outline.size();
  const auto outward = [&](std::size_t i) {
    const Flat &p = outline[i % n], &q = outline[(i + 1) % n];
    const double l = std::hypot(q[0] - p[0], q[1] - p[1]);
    return Flat{(q[1] - p[1]) / l, (p[0] - q[0]) / l};
  };
  std::vector<Flat> out(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Flat before = outward(i + n - 1), after = outward(i);
    const double along = 1 + before[0] * after[0] + before[1] * after[1];
    if (!(along > kNeedle)) return {};
    for (std::size_t k = 0; k < 2; ++k) out[i][k] = outline[i][k] + room / along * (before[k] + after[k]);
  }
  return out;
}

LatticeMesh prism(const Slab& slab, const std::vector<Flat>& outline, double room) {
  LatticeMesh mesh;
  const auto n = std::uint32_t(outline.size());
  for (const double height : {slab.low - room, slab.high + room}) {
    for (const Flat& p : outline) {
      const Vec3d q = slab.point(p, height);
      mesh.vertices.push_back({std::llround(q[0]), std::llround(q[1]), std::llround(q[2])});
    }
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    mesh.triangles.push_back({i, j, j + n});
    mesh.triangles.push_back({i, j + n, i + n});
    if (i == 0 || j == 0) continue;
    mesh.triangles.push_back({0, j, i});
    mesh.triangles.push_back({n, i + n, j + n});
  }
  return mesh;
}

/// Whether each of these points lies inside of each face's plane. Then the mesh is a sphere around them, and all that
/// lies between them is inside.
bool holds(const LatticeMesh& mesh, const Slab& slab, const std::vector<Flat>& outline) {
  constexpr double kLeast = 0.5;  // far more than what is lost by rounding
  const auto at = [&](std::uint32_t v) {
    const LatticeCoord& p = mesh.vertices[v];
    return Vec3d{double(p.x), double(p.y), double(p.z)} - slab.origin;
  };
  return std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& t) {
    const Vec3d p = at(t[0]), normal = cross(at(t[1]) - p, at(t[2]) - p);
    return std::all_of(outline.begin(), outline.end(), [&](const Flat& corner) {
      return std::max(dot(slab.point(corner, slab.low) - slab.origin - p, normal),
                      dot(slab.point(corner, slab.high) - slab.origin - p, normal)) <= -kLeast * length(normal);
    });
  });
}

}  // namespace

std::optional<LodLevel> prism_level(const LodLevel& level, std::span<const TriangleD> scene, std::uint64_t faces) {
  std::vector<Vec3d> points;
  for (const TriangleD& t : scene) {
    for (const Vec3d& p : t) points.push_back(double(kLatticePerVoxel) * level.mesh.frame.to_voxels(p));
  }
  if (points.empty()) return {};
  const std::optional<Slab> slab = slab_of(points);
  if (!slab) return {};
  std::vector<Flat> flat(points.size());
  std::transform(points.begin(), points.end(), flat.begin(), [&](const Vec3d& p) { return slab->flat(p); });
  const std::vector<Flat> hull = hull_of_flat(std::move(flat)), outline = without_straight(hull);
  if (hull.size() < 3 || 4 * outline.size() - 4 > faces) return {};
  for (double room = 2; room <= 8; room *= 2) {
    const std::vector<Flat> corners = grown(outline, room);
    if (corners.empty()) return {};
    const LatticeMesh mesh = prism(*slab, corners, room);
    if (holds(mesh, *slab, hull)) return convex_level(level, mesh);
  }
  return {};
}

}  // namespace bp
