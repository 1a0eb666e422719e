#pragma once
#include <optional>
#include <vector>

#include "lib/mesh/constrained_minimum.h"
#include "lib/mesh/face_tree.h"
#include "lib/mesh/guard.h"
#include "lib/mesh/shells.h"
#include "lib/simplify/simplify.h"
#include "lib/simplify/waves.h"

/// What a single edge collapse costs, where its vertex goes, whether it may be taken.
namespace bp {

/// What collapses are planned on. It changes only between plans.
struct CollapseGround {
  const HalfEdgeMesh& mesh;
  const FaceTree& tree;
  const SimplifyParams& params;
  const std::vector<Quadric>& quadrics;    ///< per vertex, about its position
  const std::optional<ShellSense>& sense;  ///< none while collapses only grow the solid
  LatticeBox room{};        ///< new vertices are strictly inside: of the cell, and near enough to multiply exactly
  double volume6 = 0;       ///< of the mesh as it was given, where growth is limited
  bool only_grows = false;  ///< so the surface bounds a solid from outside all the time
};

struct CollapsePlan {
  enum class Outcome { refused, too_dear, allowed };
  HalfEdgeId edge = kNoId;
  Outcome outcome = Outcome::refused;
  Refusal refusal = Refusal::none;  ///< of the attempt that came furthest
  double cost = 0;                  ///< lattice units^4, unless refused
  // If allowed:
  LatticeCoord position;
  Quadric quadric;                ///< of the merged vertex
  FaceId face = kNoId;            ///< one of those replaced
  int128 gain6 = 0;               ///< of the volume
  std::vector<FaceId> swallowed;  ///< between the old star and the new one
  EditBoxes boxes;                ///< of the new faces, or around all faces if parts may be swallowed
};

/// Plans collapses, and changes nothing. Planners of one ground may work at the same time, unless it has limits.
class CollapsePlanner {
 public:
  explicit CollapsePlanner(const CollapseGround& ground);

  /// No collapse of the edge costs less: the minimum of its summed quadrics.
  [[nodiscard]] double lower_bound(HalfEdgeId h) const;

  /// The first place where the guard lets the edge merge; not sought if the first of all costs more than `most`.
  void plan(HalfEdgeId h, double most, CollapsePlan& plan);

  std::uint64_t solved = 0;  ///< quadratic programs

 private:
  /// A place that passed every test but the guard.
  struct Candidate {
    LatticeCoord position;
    double cost = 0;  // of the summed quadrics at `position`, lattice units^4
    int attempt = 0;  // which of the places to try it is
  };
  /// A face around one of the edge's ends; coordinates relative to from(edge).
  struct StarFace {
    FaceId face;
    VertexId a, b;              // its corners besides the end, counter-clockwise
    LatticeCoord apex, pa, pb;  // of the end, a, b
    LatticeCoord normal;
    bool lost;  // one of the edge's own two faces
  };

  /// The first place from number `first_attempt` on for the vertex that the edge merges into; nothing if there is none.
  [[nodiscard]] std::optional<Candidate> solve(HalfEdgeId h, int first_attempt);
  [[nodiscard]] bool may_be_taken(const LatticeCoord& p);
  void fill(const Candidate& candidate, CollapsePlan& plan) const;
  [[nodiscard]] Quadric summed(HalfEdgeId h) const;
  [[nodiscard]] Vec3d midpoint(HalfEdgeId h) const;
  void gather_star(HalfEdgeId h);
  [[nodiscard]] bool link_holds() const;
  void gather_constraints();
  [[nodiscard]] std::optional<Candidate> place_growing(const Quadric& q, const Vec3d& prior);
  [[nodiscard]] std::optional<Candidate> place_free(const Quadric& q, const Vec3d& prior, int first_attempt);
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
  [[nodiscard]] bool leaves_near() const;
  [[nodiscard]] bool is_free(const LatticeCoord& p);
  [[nodiscard]] bool turns_over(const LatticeCoord& p) const;
  [[nodiscard]] bool swallows(FaceId f, const LatticeCoord& p) const;
  /// Keeps the refusal of the attempt that came furthest.
  bool refuse(Refusal why) {
    refusal_ = std::max(refusal_, why);
    return false;
  }

  const CollapseGround& ground_;
  const HalfEdgeMesh& mesh_;
  const SimplifyParams& params_;
  Guard guard_;
  Refusal refusal_ = Refusal::none;
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
  Blocker blocker_;  // of the last place for the edge
  std::vector<LatticeCoord> normals_before_;
  std::vector<FaceId> swallowed_;  // faces between the old star and the new one, then their connected parts
};

}  // namespace bp
