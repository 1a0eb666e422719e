#pragma once
#include <array>
#include <vector>

#include "lib/enclosed/contact_points.h"
#include "lib/mesh/lanes.h"
#include "lib/tighten/contact_forces.h"
#include "lib/tighten/detail/face_blocks.h"

/// Where all vertices of a proxy should go at once, so that it encloses less and still lies over its contact points.
/// Moved one at a time, vertices jam: a face that rests on three points holds its corners. The volume and the heights
/// of the faces over the points are linearised in all coordinates together; a stiffness per vertex bounds the step:
/// a convex quadratic program. In doubles, and its forces in floats: a proposal, which the caller checks exactly.
namespace bp {

class JointFit {
 public:
  /// Keeps references. Locked vertices stay where they are. `forces`: of this mesh and these points, also before it
  /// changed; none at first.
  JointFit(const HalfEdgeMesh& mesh, const ContactPoints& contacts, ContactForces& forces);

  /// For the mesh as it is: with nothing in its way a vertex would go `reach` times its mean spoke. Cost: linear in
  /// faces and in points, of which those at corners count for each face there; 150 bytes for each of these. Parallel
  /// for a large mesh that is whole; the result does not depend on the number of threads.
  void solve(double reach);

  [[nodiscard]] const Vec3d& shift(VertexId v) const { return shift_[v]; }  ///< where v should go, lattice units
  /// Volume that this would add, the other vertices staying where they are; to first order, lattice units cubed.
  [[nodiscard]] double growth(VertexId v) const;

 private:
  /// The height of a face over a point: the sum of gradient . shift over the corners must be `least` or more.
  struct Row {
    std::array<FourFloats, 3> gradient;   // of each corner; in the fourth lanes: `least`, `ease`, nothing
    std::array<std::uint32_t, 3> places;  // of the corners, in moving_
    float force;                          // multiplier, 0 or more
    [[nodiscard]] float least() const { return gradient[0][3]; }
    [[nodiscard]] float ease() const { return gradient[1][3]; }  ///< force that raises the height by a unit
  };
  /// What a row is of.
  struct RowKey {
    FaceId face;
    std::uint32_t point;
  };
  /// A vertex, at a place of its own: those near in space near each other. The fourth lanes are 0.
  struct Moving {
    FourFloats shift;
    FourFloats softness;  // shift by a unit of force
  };
  /// Rows that no other block's rows of the same phase share a vertex with.
  struct Block {
    std::vector<Row> rows;
    std::vector<RowKey> keys;             // of the rows
    std::vector<std::uint32_t> pressing;  // those with a force
    void clear();
    void append(const Block& other);
  };
  struct Facet {
    FaceId id;
    std::size_t block;
    std::array<std::uint32_t, 3> places;
    std::array<Vec3d, 3> corners;
    std::array<double, 3> softness;
    double reach;  // of its corners, the largest
    bool held;     // by a locked corner
    double area;   // twice
  };
  void set_free_shifts(double reach);
  void set_free_shift(VertexId v, double reach);
  void set_places();
  [[nodiscard]] Facet facet(FaceId f) const;
  void gather_rows();
  void add_rows(FaceId f, std::vector<Block>& to) const;
  void add_rows_beside(const Facet& facet, std::uint32_t point, std::vector<Block>& to) const;
  void add_row(const Facet& facet, std::uint32_t point, std::vector<Block>& to) const;
  void relax(Block& block);
  void relax(Row& row);
  void push(const Row& row, float force);
  void keep_forces();

  const HalfEdgeMesh& mesh_;
  const ContactPoints& contacts_;
  ContactForces& forces_;
  const bool whole_;                       // and large: rows are relaxed in several blocks at once
  std::vector<Vec3d> shift_, gradient_;    // per vertex; gradient of the volume
  std::vector<double> reach_, softness_;   // per vertex: unhindered step; shift by a unit of force
  std::vector<VertexId> living_;           // by place
  std::vector<std::uint32_t> place_;       // per vertex
  std::vector<Moving> moving_;             // by place
  FaceBlocks at_;                          // where rows go
  std::vector<Block> blocks_;              // of each phase, and one of all other rows
  std::vector<std::vector<Block>> parts_;  // of each block, by faces
};

}  // namespace bp
