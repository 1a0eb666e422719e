#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "lib/core/coords.h"

/// Cuts polygons into triangles. Every reader of scenes and of meshes uses it, so all tools see the same triangles.
namespace bp {

/// Numbers of corners, in the order in which the polygon has them.
using CutTriangle = std::array<std::uint32_t, 3>;

/// Returns triangle i of the fan from the first corner.
[[nodiscard]] constexpr CutTriangle fan_triangle(std::size_t i) {
  return {0, std::uint32_t(i + 1), std::uint32_t(i + 2)};
}

/// Returns true only if PolygonCutter gives the fan for this quad. It is a quick answer for most quads. The axis is the
/// largest component of the quad's normal. A component of a triangle's normal is off by less than 5 u (|l| + |r|),
/// where l and r are its two products (predicates.h). Their sum is at most the squares of the three differences.
[[nodiscard]] inline bool is_surely_fan(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
  const double ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2];
  const double vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
  const double wx = d[0] - a[0], wy = d[1] - a[1], wz = d[2] - a[2];
  const double x1 = uy * vz - uz * vy, y1 = uz * vx - ux * vz, z1 = ux * vy - uy * vx;
  const double x2 = vy * wz - vz * wy, y2 = vz * wx - vx * wz, z2 = vx * wy - vy * wx;
  const double x = std::abs(x1 + x2), y = std::abs(y1 + y2), z = std::abs(z1 + z2);
  const bool by_x = x >= y;
  const bool by_z = z >= x && z >= y;
  const double first = by_z ? z1 : by_x ? x1 : y1, second = by_z ? z2 : by_x ? x2 : y2;
  const double squares = (ux * ux + uy * uy + uz * uz) + (vx * vx + vy * vy + vz * vz) + (wx * wx + wy * wy + wz * wz);
  return first * second > 0 && std::min(std::abs(first), std::abs(second)) > 6 * 0x1p-53 * squares;
}

/// Cuts one polygon after the other. Signs are exact, so the result depends only on the corners.
class PolygonCutter {
 public:
  static constexpr std::size_t kMostCorners = 4096;  ///< of a polygon that is cut by ears: bounds time and memory

  /// Returns the n - 2 triangles of a polygon of n corners; empty for those of its fan. Valid until the next call.
  /// The polygon is seen along the axis that its normal (Newell's, the sum of the fan's normals) is nearest to. A
  /// triangle *folds* if it faces the other way there. If no triangle of the fan folds, the fan stays, as for each
  /// polygon that is convex there. Otherwise ears are clipped. That gives triangles without folds if the polygon is
  /// simple there, or has a hole that a double edge leads to. The fan stays also if no such triangles are found,
  /// because the outline crosses itself; if there are more than kMostCorners corners; or if a corner is outside of the
  /// predicates' domain. Triangles without folds cover exactly the polygon: the edges between them cancel, so as many
  /// triangles lie over a point as the outline winds around it. A simple outline winds once around points inside, and
  /// around no others. Time: n for a fan, else at most n² (4,096 corners took 10 ms at most in the shapes tried).
  [[nodiscard]] std::span<const CutTriangle> cut(std::span<const Vec3d> corners);

 private:
  enum class Ear : std::uint8_t { unknown, yes, no };

  void project(std::span<const Vec3d> corners, int axis, bool mirrored);
  void sort_blockers();
  bool clip();
  bool clip_any(std::uint32_t& tip);
  void remove(std::uint32_t tip);
  bool is_ear(std::uint32_t tip);
  [[nodiscard]] bool is_free(std::uint32_t tip) const;
  [[nodiscard]] bool blocks(std::uint32_t p, const std::array<std::uint32_t, 3>& ear) const;
  [[nodiscard]] int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
  [[nodiscard]] int turn_at(std::uint32_t tip) const { return turn(before_[tip], tip, after_[tip]); }

  std::vector<CutTriangle> triangles_;
  std::vector<Vec3d> points_;  // corners in the plane, counter-clockwise as a whole; z is 0
  std::vector<std::uint32_t> before_, after_;
  std::vector<Ear> ears_;
  std::vector<bool> removed_;
  std::vector<std::uint32_t> blockers_;  // places along along_ of the corners that are not strictly convex
  std::size_t along_ = 0, left_ = 0;     // left_: number of corners that are not clipped yet
};

}  // namespace bp
