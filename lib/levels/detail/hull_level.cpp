#include "lib/levels/detail/hull_level.h"

#include <algorithm>
#include <cmath>

#include "lib/core/vec3.h"
#include "lib/hulls/convex_hull.h"
#include "lib/levels/detail/few_faces_level.h"

namespace bp {

namespace {

constexpr std::size_t kMostTriangles = 65536;
constexpr double kFar = kLatticePerVoxel / 2.0;
constexpr double kReach = double(std::int64_t(1) << 28);  // what hull_of() takes

LatticeCoord rounded_to_lattice(const Vec3d& p) {
  return {std::llround(p[0]), std::llround(p[1]), std::llround(p[2])};
}

/// Of its volume.
Vec3d middle_of(const ConvexHull& hull) {
  const LatticeCoord origin = hull.vertices.front();
  Vec3d sum{};
  double volume = 0;
  for (const auto& [i, j, k] : hull.triangles) {
    const Vec3d a = to_double(hull.vertices[i] - origin), b = to_double(hull.vertices[j] - origin),
                c = to_double(hull.vertices[k] - origin);
    const double part = dot(a, cross(b, c));
    sum = sum + (part / 4) * (a + b + c);
    volume += part;
  }
  return to_double(origin) + (1 / volume) * sum;
}

/// The least, over the faces, of how far p lies below one.
double depth(const ConvexHull& hull, const Vec3d& p) {
  double least = HUGE_VAL;
  for (const auto& [a, b, c] : hull.triangles) {
    const Vec3d q = to_double(hull.vertices[a]),
                normal = cross(to_double(hull.vertices[b]) - q, to_double(hull.vertices[c]) - q);
    least = std::min(least, dot(q - p, normal) / length(normal));
  }
  return least;
}

/// Away from its middle, until each face has moved by `room`; nothing if that takes a corner far.
std::optional<ConvexHull> grown(const ConvexHull& hull, double room) {
  const Vec3d middle = middle_of(hull);
  const double share = room / depth(hull, middle);
  std::vector<LatticeCoord> points;
  for (const LatticeCoord& v : hull.vertices) {
    const Vec3d by = share * (to_double(v) - middle);
    if (!(length(by) < kFar)) return {};
    points.push_back(v + rounded_to_lattice(by));
  }
  return hull_of(points);
}

}  // namespace

std::optional<LodLevel> hull_level(const LodLevel& level, std::span<const TriangleD> scene, std::uint64_t faces) {
  constexpr double kLeast = 0.5;  // far more than what is lost by computing
  if (scene.empty() || scene.size() > kMostTriangles) return {};
  std::vector<Vec3d> points;
  std::vector<LatticeCoord> near;
  for (const TriangleD& t : scene) {
    for (const Vec3d& p : t) {
      points.push_back(double(kLatticePerVoxel) * level.mesh.frame.to_voxels(p));
      if (!(length(points.back()) < kReach)) return {};
      near.push_back(rounded_to_lattice(points.back()));
    }
  }
  const std::optional<ConvexHull> hull = hull_of(near);
  if (!hull || hull->triangles.size() > faces) return {};
  for (double room = 2; room <= 8; room *= 2) {
    const std::optional<ConvexHull> around = grown(*hull, room);
    if (!around || around->triangles.size() > faces) return {};
    if (std::any_of(points.begin(), points.end(), [&](const Vec3d& p) { return depth(*around, p) < kLeast; })) continue;
    LatticeMesh mesh;
    mesh.vertices = around->vertices;
    mesh.triangles = around->triangles;
    return convex_level(level, mesh);
  }
  return {};
}

}  // namespace bp
