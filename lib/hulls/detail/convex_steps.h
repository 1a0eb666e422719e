#pragma once
#include <optional>
#include <vector>

#include "lib/hulls/convex_hull.h"
#include "lib/mesh/box_tree.h"
#include "lib/mesh/constrained_minimum.h"

/// Steps that take corners from a convex hull and leave it around what it was around [SGG00].
namespace bp {

/// An edge, and the point that would take its place.
struct HullStep {
  std::uint32_t a, b;
  LatticeCoord point;
  double cost6;  ///< six times the volume between the hull and the point
};

class HullSteps {
 public:
  /// Keeps a reference. No point lies outside of `room`. Linear.
  HullSteps(const ConvexHull& hull, const LatticeBox& room);

  /// One for each edge that has one, cheapest first. Cost: two small quadratic programs an edge.
  [[nodiscard]] std::vector<HullStep> all() const;
  /// A place that may take that of a corner alone.
  [[nodiscard]] std::optional<LatticeCoord> point_beyond(std::uint32_t v) const;
  /// Corners of the faces around both ends of the edge: another step there would be for another hull.
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
  std::vector<std::vector<std::uint32_t>> around_;  // per vertex: its faces
};

/// The box around a hull, grown on each side by a share of its longest one: where corners may go. A point beyond the
/// planes around a sharp edge adds next to nothing to the volume, and may lie far out. `share`: at most 1, since beyond
/// that lie solutions of nearly singular systems.
[[nodiscard]] LatticeBox room_around(const ConvexHull& hull, double share);

/// The hull of `hull` and a point.
[[nodiscard]] ConvexHull with_point(const ConvexHull& hull, const LatticeCoord& point);

}  // namespace bp
