#pragma once
#include <optional>
#include <vector>

#include "lib/core/box.h"
#include "lib/core/grid_frame.h"
#include "lib/core/triangle_source.h"
#include "lib/enclosed/eight_triangles.h"
#include "lib/enclosed/enclosed.h"

namespace bp {

/// The triangles of a scene, in scene units and exactly as read: the proxy must not even touch them. All are in memory:
/// 108 bytes each, about 40 for the tree, and the contact points. `frame`: the proxy's frame; its vertices are exact
/// doubles, so the predicates on doubles are exact, too. If `within` (scene units) is given, only the triangles' parts
/// in this closed box must stay inside; elsewhere a face may cut them. A part that is nearly met then counts as met
/// (triangle_part.h). If the triangles were rounded when they were read, no face comes as near to one as it may be off
/// by: it stays inside wherever it lies in its file.
class EnclosedTriangles : public Enclosed {
 public:
  EnclosedTriangles(std::vector<TriangleD> triangles, const GridFrame& frame,
                    const std::optional<Bounds3d>& within = {}, const Rounding& rounding = {});
  [[nodiscard]] bool allows(std::span<const NewFace> star, std::span<const Tetrahedron> swept,
                            Blocker* blocker) const override;
  [[nodiscard]] std::vector<Vec3d> contact_points(const LatticeCoord& origin, const LatticeBox& within) const override;
  [[nodiscard]] bool is_exact() const override { return true; }
  void outer_boxes(const UseBoxes& use) const override;
  [[nodiscard]] std::uint64_t bytes() const override;
  /// The triangle, its corners in floats, about 40 bytes for the tree, a bit for its area, and a contact point.
  static constexpr std::uint64_t kBytesEach =
      sizeof(TriangleD) + sizeof(EightTriangles) / 8 + 40 + kBytesPerContactPoint;

 private:
  class Swept;
  std::vector<Vec3d> cut_to(const Bounds3d& within, std::vector<TriangleD>& triangles) const;
  double set_corners(std::size_t triangle);
  [[nodiscard]] double kept_from(const TriangleD& t) const;
  [[nodiscard]] LatticeBox box_around(const TriangleD& t) const;
  [[nodiscard]] LatticeBox box_around(const Vec3d& p) const;
  [[nodiscard]] bool has_area(std::size_t triangle) const { return (no_area_[triangle / 8] >> triangle % 8 & 1) == 0; }
  void add_samples_of(std::size_t triangle, std::vector<Vec3d>& points) const;
  [[nodiscard]] std::vector<Vec3d> all_samples() const;
  [[nodiscard]] bool is_free(Swept swept, const BoxTree::Nearby* nearby, Blocker* blocker) const;
  void report(std::size_t triangle, Blocker& blocker) const;

  std::vector<TriangleD> triangles_;  // in the order of the tree
  GridFrame frame_;
  std::optional<Bounds3d> within_;
  Rounding rounding_;
  double kept_from_all_ = 0;    // the largest distance that faces keep from a triangle; lattice units
  std::vector<Vec3d> middles_;  // with within_: per triangle the middle of its part, about; lattice units
  BoxTree tree_;
  LatticeBox bounds_;
  std::vector<EightTriangles> eights_;  // relative to the tree's base
  std::vector<std::uint8_t> no_area_;   // one bit per triangle: it is a segment or a point
  double reach_ = 0;                    // largest coordinate in eights_
  std::vector<Vec3d> samples_;          // sorted by their first coordinate
};

}  // namespace bp
