#pragma once
#include <optional>
#include <vector>

#include "lib/enclosed/enclosed.h"
#include "lib/mesh/constrained_minimum.h"
#include "lib/mesh/guard.h"
#include "lib/mesh/half_edge_mesh.h"

namespace bp {

/// The faces around an edge that may collapse, and what they demand of the place of the merged vertex. Places are
/// relative to origin().
class EdgeStar {
 public:
  /// A face around one of the edge's ends.
  struct Face {
    FaceId face;
    VertexId a, b;              ///< its corners besides the end, counter-clockwise
    LatticeCoord apex, pa, pb;  ///< positions of the end, of a and of b
    LatticeCoord normal;
    bool lost;  ///< one of the two faces at the edge, which vanish
  };

  /// Goes to another edge.
  void gather(const HalfEdgeMesh& mesh, HalfEdgeId h);
  [[nodiscard]] const LatticeCoord& origin() const { return origin_; }  ///< position of from(h)
  /// Returns the faces around from(h), then those around to(h) without the edge's own two.
  [[nodiscard]] const std::vector<Face>& faces() const { return faces_; }
  [[nodiscard]] LatticeBox box() const;
  /// As HalfEdgeMesh::can_collapse, from the rings gathered.
  [[nodiscard]] bool link_holds() const;

  /// Sets `constraints` to the half-spaces outside the planes of the faces. Faces of a flat region follow each other
  /// and give one half-space.
  void constrain(std::vector<PlaneConstraint>& constraints) const;
  /// Returns the cheapest lattice point near x that is exactly on or outside all planes.
  [[nodiscard]] std::optional<LatticeCoord> round_inside(const Vec3d& x, const Quadric& q) const;
  /// Returns the volume that a collapse to p adds, times 6.
  [[nodiscard]] double growth6(const LatticeCoord& p) const;

  /// Sets `fan` to the faces that replace the star if the edge collapses to p, and `replaced` to the star's.
  void fan_to(const LatticeCoord& p, std::vector<NewFace>& fan, std::vector<FaceId>& replaced) const;
  /// Sets `swept` to the tetrahedra between p and the faces that p lies inside of.
  void swept_to(const LatticeCoord& p, std::vector<Tetrahedron>& swept) const;
  /// Returns whether a point lies between the old star and the new one. `three`: three times the point.
  [[nodiscard]] bool lies_between(const LatticeCoord& three, const LatticeCoord& p) const;

 private:
  void gather_fan(const HalfEdgeMesh& mesh, HalfEdgeId first, VertexId other, bool both);
  /// Returns whether p is on or outside the plane of every face of the star; exact.
  [[nodiscard]] bool outside_all(const LatticeCoord& p) const;

  LatticeCoord origin_;
  VertexId kept_ = kNoId;  // from(h)
  std::vector<Face> faces_;
  std::vector<VertexId> ring_;  // neighbours of from(h), then those of to(h) without from(h)
  std::size_t ring_split_ = 0;  // where the neighbours of to(h) begin
};

/// If the constraints of a star contradict each other: moves the place along the mean normal until most of them hold.
[[nodiscard]] Vec3d pushed_out(const EdgeStar& star, const Vec3d& x, const std::vector<PlaneConstraint>& constraints);

/// Returns whether no face of the star flips, vanishes or becomes a needle if its edge collapses to p.
[[nodiscard]] bool shape_is_fine(const EdgeStar& star, const LatticeCoord& p);

}  // namespace bp
