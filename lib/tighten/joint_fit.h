#pragma once
#include <array>
#include <vector>

#include "lib/enclosed/contact_points.h"
#include "lib/mesh/lanes.h"
#include "lib/tighten/contact_forces.h"
#include "lib/tighten/face_blocks.h"

/// Finds where all vertices of a proxy should go at once, so that it encloses less volume and still lies over its
/// contact points. Vertices that move one at a time jam, since a face that rests on three points holds its corners. The
/// volume and the heights of faces over points are linearised in all coordinates together, and a stiffness at each
/// vertex bounds the step: this is a convex quadratic program. The result is in doubles, with forces in floats: a
/// proposal that the caller checks exactly.
namespace bp {

class JointFit {
 public:
  /// Keeps references. Locked vertices do not move. `forces`: from an earlier fit of this mesh and these points, even
  /// if the mesh has changed since; empty at first.
  JointFit(const HalfEdgeMesh& mesh, const ContactPoints& contacts, ContactForces& forces);

  /// Solves the program for the present mesh. A vertex that nothing hinders would go `reach` times its mean spoke.
  /// Cost: linear in faces and points, where a point at a corner counts once for each face there; 150 bytes for each of
  /// these. Parallel for a large whole mesh; the result does not depend on the number of threads.
  void solve(double reach = 1);

  /// Where v should go from its place, lattice units.
  [[nodiscard]] const Vec3d& shift(VertexId v) const { return shift_[v]; }
  /// Returns the volume that moving v alone by its shift would add, to first order, lattice units cubed.
  [[nodiscard]] double growth(VertexId v) const;

 private:
  /// A constraint on the height of a face over a point: the sum of gradient . shift over the corners must be at least
  /// `least`.
  struct Row {
    std::array<FourFloats, 3> gradient;   // for each corner; the fourth lanes hold `least`, `ease` and nothing
    std::array<std::uint32_t, 3> places;  // places of the corners in moving_
    float force;                          // multiplier, 0 or more
    [[nodiscard]] float least() const { return gradient[0][3]; }
    [[nodiscard]] float ease() const { return gradient[1][3]; }  ///< force that raises the height by a unit
  };
  /// The face and the point of a row.
  struct RowKey {
    FaceId face;
    std::uint32_t point;
  };
  /// A vertex at its place: neighbours in space are near each other. The fourth lanes are 0.
  struct Moving {
    FourFloats shift;
    FourFloats softness;  // shift caused by a unit of force
  };
  /// A set of rows. Blocks of the same phase have no vertex in common.
  struct Block {
    std::vector<Row> rows;
    std::vector<RowKey> keys;             // of each row
    std::vector<std::uint32_t> pressing;  // numbers of the rows with a force
    void clear();
    void append(const Block& other);
  };
  struct Facet {
    FaceId id;
    std::size_t block;
    std::array<std::uint32_t, 3> places;
    std::array<Vec3d, 3> corners;
    std::array<double, 3> softness;
    double reach;  // the largest reach of its corners
    bool held;     // a corner is locked
    double area;   // twice the area
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
  const bool whole_;                       // the mesh is whole and large: several blocks are relaxed at once
  std::vector<Vec3d> shift_, gradient_;    // for each vertex; the gradient is that of the volume
  std::vector<double> reach_, softness_;   // for each vertex: unhindered step; shift caused by a unit of force
  std::vector<VertexId> living_;           // by place
  std::vector<std::uint32_t> place_;       // for each vertex
  std::vector<Moving> moving_;             // by place
  FaceBlocks at_;                          // the block of each face
  std::vector<Block> blocks_;              // the blocks of each phase, and one for all other rows
  std::vector<std::vector<Block>> parts_;  // parts of each block, from shares of the faces
};

}  // namespace bp
