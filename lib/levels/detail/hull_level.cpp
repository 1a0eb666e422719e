#include <algorithm>
#include <cmath>

#include "lib/core/vec3.h"
#include "lib/hulls/convex_hull.h"
#include "lib/levels/detail/convex_levels.h"
#include "lib/mesh/lattice_geometry.h"

namespace bp {

namespace {

constexpr std::size_t kMostOfScene = 3 * 65536;           // corners of the scene's triangles
constexpr std::size_t kMostFaces = 16384;                 // each face is compared with each corner: 0.4 s
constexpr double kReach = double(std::int64_t(1) << 28);  // the largest coordinate that hull_of() takes

/// Returns the centre of gravity of the hull's volume.
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

struct Side {
  Vec3d point, normal;
  double area;  // twice the side's area
};

std::vector<Side> sides_of(const ConvexHull& hull) {
  std::vector<Side> sides;
  for (const auto& [a, b, c] : hull.triangles) {
    const Vec3d p = to_double(hull.vertices[a]),
                normal = cross(to_double(hull.vertices[b]) - p, to_double(hull.vertices[c]) - p);
    sides.push_back({p, normal, length(normal)});
  }
  return sides;
}

/// Returns the distance of p to the nearest side's plane; above 0: p lies below all planes.
double depth(const std::vector<Side>& sides, const Vec3d& p) {
  double least = HUGE_VAL;
  for (const Side& s : sides) least = std::min(least, dot(s.point - p, s.normal) / s.area);
  return least;
}

/// Scales the hull away from its middle, until each face has moved by at least `room`. Returns nothing if a corner
/// would move by half a voxel.
std::optional<ConvexHull> grown(const ConvexHull& hull, double room) {
  const Vec3d middle = middle_of(hull);
  const double share = room / depth(sides_of(hull), middle);
  std::vector<LatticeCoord> points;
  for (const LatticeCoord& v : hull.vertices) {
    const Vec3d by = share * (to_double(v) - middle);
    if (!(length(by) < kLatticePerVoxel / 2.0)) return {};
    points.push_back(v + rounded(by));
  }
  return hull_of(points);
}

}  // namespace

std::optional<LodLevel> hull_level(const LodLevel& level, std::span<const Vec3d> corners, double off,
                                   std::uint64_t faces) {
  constexpr double kLeast = 0.5;  // far more than the rounding of the doubles here
  if (corners.empty() || corners.size() > kMostOfScene) return {};
  std::vector<LatticeCoord> near;
  double rounding = 0;
  for (const Vec3d& p : corners) {
    if (!(length(p) < kReach)) return {};
    near.push_back(rounded(p));
    rounding = std::max(rounding, length(p - to_double(near.back())));
  }
  const std::optional<ConvexHull> hull = hull_of(near);
  if (!hull || hull->triangles.size() > std::min<std::uint64_t>(faces, kMostFaces)) return {};
  for (double room = 1; room <= 8; room *= 1.5) {
    const std::optional<ConvexHull> around = grown(*hull, room + off);
    if (!around || around->triangles.size() > faces) return {};
    const std::vector<Side> sides = sides_of(*around);
    // A corner of the scene was moved by at most `rounding`, and its rounded place lies in the hull.
    const auto is_deep = [&](const LatticeCoord& p) { return depth(sides, to_double(p)) >= kLeast + rounding + off; };
    if (!std::all_of(hull->vertices.begin(), hull->vertices.end(), is_deep)) continue;
    LatticeMesh mesh;
    mesh.vertices = around->vertices;
    mesh.triangles = around->triangles;
    return convex_level(level, mesh);
  }
  return {};
}

}  // namespace bp
