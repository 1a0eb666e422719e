#pragma once
#include <optional>
#include <vector>

#include "lib/hulls/convex_hull.h"
#include "lib/mesh/box_tree.h"
#include "lib/mesh/constrained_minimum.h"

/// Steps that take corners from a convex hull and keep it around what it was around [SGG00].
namespace bp {

/// An edge, and the point that would replace it.
struct HullStep {
  std::uint32_t a, b;
  LatticeCoord point;
  double cost6;  ///< six times the volume between the hull and the point
};

class HullSteps {
 public:
  /// Keeps a reference. No point may lie outside of `room`. Linear.
  HullSteps(const ConvexHull& hull, const LatticeBox& room);

  /// Returns a step for each edge that has one, the cheapest first. Cost: two small quadratic programs an edge.
  [[nodiscard]] std::vector<HullStep> all() const;
  /// Returns a place that may replace a corner alone.
  [[nodiscard]] std::optional<LatticeCoord> point_beyond(std::uint32_t v) const;
  /// Returns the corners of the faces around both ends of the edge. Another step there would belong to another hull.
  [[nodiscard]] std::vector<std::uint32_t> reach(const HullStep& step) const;

 private:
  [[nodiscard]] std::optional<LatticeCoord> point_for(const Quadric& quadric,
                                                      const std::vector<PlaneConstraint>& planes,
                                                      const LatticeCoord& base, const LatticeCoord& other) const;
  [[nodiscard]] std::optional<LatticeCoord> point_beyond(std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] double volume6_to(const LatticeCoord& p) const;

  const ConvexHull& hull_;
  LatticeBox room_;
  std::vector<Vec3d> normals_;
  std::vector<std::vector<std::uint32_t>> around_;  // by vertex: its faces
};

/// Returns the box around a hull, grown on each side by a share of its longest side. Corners may move within it. A
/// point beyond the planes around a sharp edge adds next to nothing to the volume, and may lie far out. `share` is at
/// most 1, since solutions of nearly singular systems lie beyond that.
[[nodiscard]] LatticeBox room_around(const ConvexHull& hull, double share);

/// Returns the hull of `hull` and a point.
[[nodiscard]] ConvexHull with_point(const ConvexHull& hull, const LatticeCoord& point);

}  // namespace bp
