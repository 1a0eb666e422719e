#pragma once
#include <array>
#include <span>
#include <vector>

#include "lib/fit/fit_place.h"
#include "lib/mesh/half_edge_mesh.h"
#include "lib/mesh/lattice_geometry.h"
#include "lib/mesh/quadric.h"

/// The points of the scene that a mesh approximates, each with the face of the mesh that is nearest to it.
namespace bp {

class FacePoints {
 public:
  /// The points must outlive this.
  explicit FacePoints(std::span<const FitPlace> points) : points_(points) {}

  /// Finds the nearest face of the mesh, as it is now, for each point. One search for each point, in parallel; the
  /// result does not depend on the number of threads.
  void assign(const HalfEdgeMesh& mesh);

  [[nodiscard]] std::span<const std::uint32_t> of(FaceId f) const {
    return {order_.data() + begin_[f], begin_[f + 1] - begin_[f]};
  }
  [[nodiscard]] const FitPlace& operator[](std::uint32_t i) const { return points_[i]; }
  /// Returns the place on the point's face that is nearest to the point, as shares of the face's corners.
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

/// Returns a quadric for each vertex of the mesh, relative to the vertex: the sum of the planes of its faces, weighted
/// by the areas of the faces. A face's planes are those at the points assigned to it; without a point that has a
/// normal, its own plane. So a face that cuts off an edge of the scene has the planes of both sides of that edge. At
/// the rim of an open sheet, a plane across the rim is added with the weight `point_area` for each point there (the
/// area of the dense surface that a point represents): it keeps plates from shrinking.
[[nodiscard]] std::vector<Quadric> quadrics_of_points(const HalfEdgeMesh& mesh, std::span<const FitPlace> points,
                                                      double point_area);

}  // namespace bp
