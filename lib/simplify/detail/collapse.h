#pragma once
#include <optional>
#include <vector>

#include "lib/mesh/constrained_minimum.h"
#include "lib/mesh/face_tree.h"
#include "lib/mesh/guard.h"
#include "lib/mesh/shells.h"
#include "lib/simplify/simplify.h"

/// Single edge collapses: what one costs, where its vertex goes, whether it may be taken. The orders in which they are
/// taken are in bulk_order.h and collapse_order.h.
namespace bp {

/// A collapse that passed every test but the guard.
struct Candidate {
  LatticeCoord position;
  double cost = 0;  ///< of the summed quadrics at `position`, lattice units^4
  int attempt = 0;  ///< which of the places to try it is
};

/// Per vertex and about it: the planes of its faces, weighted by their areas.
[[nodiscard]] std::vector<Quadric> quadrics_of(const HalfEdgeMesh& mesh);
[[nodiscard]] std::vector<Quadric> quadrics_of(const Piece& piece);

class Collapser {
 public:
  /// Keeps references. `quadrics` per vertex, about its position; empty: of the faces as they are. Vertices on the
  /// boundary of the mesh's cell are locked, and new ones stay strictly inside it: what happens in a cell can meet
  /// nothing of what happens in others (docs/bounding.md).
  Collapser(HalfEdgeMesh& mesh, std::vector<Quadric> quadrics, const SimplifyParams& params, SimplifyCounts& counts);

  [[nodiscard]] HalfEdgeMesh& mesh() { return mesh_; }
  [[nodiscard]] const HalfEdgeMesh& mesh() const { return mesh_; }
  [[nodiscard]] const SimplifyParams& params() const { return params_; }
  [[nodiscard]] const Quadric& quadric(VertexId v) const { return quadric_[v]; }
  /// Which shells have turned; null while collapses only grow the solid: they leave none that has.
  [[nodiscard]] const ShellSense* sense() const { return sense_ ? &*sense_ : nullptr; }

  /// No collapse of the edge costs less: the minimum of its summed quadrics.
  [[nodiscard]] double lower_bound(HalfEdgeId h) const;

  /// The first place from number `first_attempt` on for the vertex that the edge merges into; nothing if there is none.
  [[nodiscard]] std::optional<Candidate> solve(HalfEdgeId h, int first_attempt = 0);

  /// Collapses h to the candidate that solve(h) has just returned or, where the guard refuses it, to the next one. The
  /// merged vertex is from(h); it is dead if what it belonged to was inside other parts then, and was erased. False if
  /// the guard refuses all.
  bool take(HalfEdgeId h, std::optional<Candidate> candidate);

  /// Why the edge last tried failed.
  [[nodiscard]] Refusal refusal() const { return refusal_; }

 private:
  /// A face around one of the edge's ends; coordinates relative to from(edge).
  struct StarFace {
    FaceId face;
    VertexId a, b;              // its corners besides the end, counter-clockwise
    LatticeCoord apex, pa, pb;  // of the end, a, b
    LatticeCoord normal;
    bool lost;  // one of the edge's own two faces
  };

  [[nodiscard]] Quadric summed(HalfEdgeId h) const;
  [[nodiscard]] Vec3d midpoint(HalfEdgeId h) const;
  void gather_star(HalfEdgeId h);
  [[nodiscard]] bool link_holds() const;
  void gather_constraints();
  [[nodiscard]] std::optional<Candidate> place_growing(const Quadric& q, const Vec3d& prior);
  [[nodiscard]] std::optional<Candidate> place_free(const Quadric& q, const Vec3d& prior);
  [[nodiscard]] std::optional<Candidate> place_enclosing(const Quadric& q, const Vec3d& prior, int first_attempt);
  [[nodiscard]] Vec3d pushed_out(const Vec3d& x) const;
  [[nodiscard]] std::optional<LatticeCoord> round_inside(const Vec3d& x, const Quadric& q) const;
  [[nodiscard]] bool outside_all(const LatticeCoord& p) const;
  [[nodiscard]] bool acceptable(const LatticeCoord& p, double cost);
  [[nodiscard]] bool shape_is_fine(const LatticeCoord& p) const;
  [[nodiscard]] bool edges_are_short(const LatticeCoord& p) const;
  [[nodiscard]] bool adds_little(const LatticeCoord& p) const;
  [[nodiscard]] bool keeps_inside(const LatticeCoord& p);
  [[nodiscard]] bool too_far(double cost) const;
  void gather_new_faces(const LatticeCoord& p);
  [[nodiscard]] bool stays_near() const;
  [[nodiscard]] bool is_free(const LatticeCoord& p);
  [[nodiscard]] bool turns_over(const LatticeCoord& p) const;
  [[nodiscard]] bool swallows(FaceId f, const LatticeCoord& p) const;
  void erase_part(FaceId f);
  void collapse_to(HalfEdgeId h, const LatticeCoord& position);
  /// Keeps the refusal of the attempt that came furthest.
  bool refuse(Refusal why) {
    refusal_ = std::max(refusal_, why);
    return false;
  }

  HalfEdgeMesh& mesh_;
  const SimplifyParams& params_;
  SimplifyCounts& counts_;
  FaceTree tree_;
  Guard guard_;
  LatticeBox room_;               // new vertices are strictly inside: of the cell, and near enough to multiply exactly
  std::vector<Quadric> quadric_;  // per vertex, about its position
  Refusal refusal_ = Refusal::none;
  double volume6_ = 0;  // of the mesh as it was given, where growth is limited
  bool only_grows_;     // so the surface bounds a solid from outside all the time
  std::optional<ShellSense> sense_;
  // Of the edge that solve() was last called with:
  LatticeCoord origin_;  // position of from(h)
  VertexId kept_ = kNoId;
  double weight_ = 0;           // area of its quadrics
  std::vector<StarFace> star_;  // around from(h), then around to(h) but for the edge's own two
  std::vector<VertexId> ring_;  // neighbours of from(h), then those of to(h) but from(h)
  std::size_t ring_split_ = 0;  // where the second ones begin
  std::vector<PlaneConstraint> constraints_;
  std::vector<NewFace> new_faces_;
  std::vector<FaceId> replaced_;
  std::vector<Tetrahedron> swept_;
  std::vector<LatticeCoord> normals_before_;
  std::vector<FaceId> swallowed_;  // faces between the old star and the new one, then their connected parts
};

}  // namespace bp
