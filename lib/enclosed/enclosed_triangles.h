#pragma once
#include <mutex>
#include <vector>

#include "lib/core/grid_frame.h"
#include "lib/enclosed/enclosed.h"

namespace bp {

/// The corners of eight triangles side by side, rounded: to leave out those that are surely clear of a change.
struct EightTriangles {
  FourFloats corners[3][3][2];  ///< of corner and axis, lattice units
};

/// The triangles of a scene, in scene units and exactly as read: the proxy must not even touch them. All in memory: 108
/// bytes each and about 40 for the tree. `frame` is the proxy's; its vertices are exact doubles, so the predicates on
/// doubles are exact too.
class EnclosedTriangles : public Enclosed {
 public:
  EnclosedTriangles(std::vector<TriangleD> triangles, const GridFrame& frame);
  [[nodiscard]] bool allows(std::span<const NewFace> star, std::span<const Tetrahedron> swept,
                            Blocker* blocker) const override;
  [[nodiscard]] std::vector<Vec3d> contact_points(const LatticeCoord& origin, const LatticeBox& within) const override;
  [[nodiscard]] std::uint64_t bytes() const override;
  /// The triangle, its corners in floats, about 40 for the tree, and a contact point.
  static constexpr std::uint64_t kBytesEach =
      sizeof(TriangleD) + sizeof(EightTriangles) / 8 + 40 + kBytesPerContactPoint;

 private:
  class Swept;
  double set_corners(std::size_t triangle);
  /// The samples of triangles, in lattice units, each once.
  [[nodiscard]] std::vector<Vec3d> samples_of(std::vector<Vec3d> world_points) const;
  [[nodiscard]] const std::vector<Vec3d>& all_samples() const;
  [[nodiscard]] bool is_free(Swept swept, Blocker* blocker) const;
  void report(const TriangleD& triangle, Blocker& blocker) const;

  std::vector<TriangleD> triangles_;  // in the order of the tree
  GridFrame frame_;
  BoxTree tree_;
  LatticeBox bounds_;
  std::vector<EightTriangles> eights_;  // relative to the tree's base
  double reach_ = 0;                    // largest coordinate in eights_
  mutable std::once_flag sampled_;
  mutable std::vector<Vec3d> samples_;  // all_samples(), once they are asked for
};

}  // namespace bp
