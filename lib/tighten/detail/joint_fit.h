#pragma once
#include <array>
#include <vector>

#include "lib/enclosed/contact_points.h"

/// Where all vertices of a proxy should go at once, so that it encloses less and still lies over its contact points.
/// Moved one at a time, vertices jam: a face that rests on three points holds its corners. The volume and the heights
/// of the faces over the points are linearised in all coordinates together; a stiffness per vertex bounds the step:
/// a convex quadratic program. All in doubles: a proposal, which the caller checks exactly.
namespace bp {

class JointFit {
 public:
  /// Keeps references. Locked vertices stay where they are.
  JointFit(const HalfEdgeMesh& mesh, const ContactPoints& contacts) : mesh_(mesh), contacts_(contacts) {}

  /// For the mesh as it is: with nothing in its way a vertex would go `reach` times its mean spoke. Cost: linear in
  /// faces and in points, of which those at corners count for each face there; 56 bytes for each of these.
  void solve(double reach);

  [[nodiscard]] const Vec3d& shift(VertexId v) const { return shift_[v]; }  ///< where v should go, lattice units
  /// Volume that this would add, the other vertices staying where they are; to first order, lattice units cubed.
  [[nodiscard]] double growth(VertexId v) const;

 private:
  using Vec3f = std::array<float, 3>;
  /// The height of a face over a point: the sum of gradient . shift over the corners must be `least` or more.
  struct Row {
    FaceId face;
    std::array<Vec3f, 3> gradient;
    float least;
    float give;   // how much the height rises by a unit of force
    float force;  // multiplier, 0 or more
  };
  struct Facet {
    FaceId id;
    std::array<Vec3d, 3> corners;
    std::array<double, 3> softness;
    double reach;  // of its corners, the largest
    bool held;     // by a locked corner
    double area;   // twice
  };
  void set_free_shifts(double reach);
  [[nodiscard]] Facet facet(FaceId f) const;
  void add_rows(FaceId f);
  void add_rows_beside(const Facet& facet, const Vec3d& p);
  void add_row(const Facet& facet, const Vec3d& p);
  void relax(Row& row);

  const HalfEdgeMesh& mesh_;
  const ContactPoints& contacts_;
  std::vector<Vec3d> shift_, gradient_;   // per vertex; gradient of the volume
  std::vector<double> reach_, softness_;  // per vertex: unhindered step; shift by a unit of force
  std::vector<Row> rows_;
  std::vector<std::uint32_t> pressing_;  // rows with a force
};

}  // namespace bp
