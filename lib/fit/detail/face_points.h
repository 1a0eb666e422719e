#pragma once
#include <array>
#include <span>
#include <vector>

#include "lib/fit/fit_place.h"
#include "lib/mesh/half_edge_mesh.h"
#include "lib/mesh/lattice_geometry.h"
#include "lib/mesh/quadric.h"

/// Points of what a mesh stands for, each with the face that is nearest to it.
namespace bp {

class FacePoints {
 public:
  /// The points must outlive this.
  explicit FacePoints(std::span<const FitPlace> points) : points_(points) {}

  /// For the mesh as it is now. One search for each point, parallel; the same result for any number of threads.
  void assign(const HalfEdgeMesh& mesh);

  [[nodiscard]] std::span<const std::uint32_t> of(FaceId f) const {
    return {order_.data() + begin_[f], begin_[f + 1] - begin_[f]};
  }
  [[nodiscard]] const FitPlace& operator[](std::uint32_t i) const { return points_[i]; }
  /// The nearest place of its face, by the shares of the face's corners.
  [[nodiscard]] const std::array<double, 3>& shares(std::uint32_t i) const { return pulls_[i].share; }

 private:
  struct Pull {
    FaceId face = 0;
    std::array<double, 3> share{};
  };
  std::span<const FitPlace> points_;
  std::vector<Pull> pulls_;                   // per point
  std::vector<std::uint32_t> begin_, order_;  // per face: a range of point numbers
};

/// The corners of a face, lattice units.
[[nodiscard]] inline std::array<Vec3d, 3> corners_of(const HalfEdgeMesh& mesh, FaceId f) {
  return {to_double(mesh.corner(f, 0)), to_double(mesh.corner(f, 1)), to_double(mesh.corner(f, 2))};
}

/// Per vertex of the mesh and about it: the planes that its faces stand for, weighted by the areas of the faces. These
/// are the planes at the points of a face; its own where it has none with a normal. So a face that cuts off an edge of
/// the scene stands for the two sides of that edge. Where the scene ends, a face has no area of its own left: there a
/// plane across the end counts with `point_area`, of the dense surface for each point. So plates keep their extent.
[[nodiscard]] std::vector<Quadric> quadrics_of_points(const HalfEdgeMesh& mesh, std::span<const FitPlace> points,
                                                      double point_area);

}  // namespace bp
