#pragma once
#include <optional>
#include <vector>

#include "lib/enclosed/enclosed.h"
#include "lib/mesh/face_tree.h"
#include "lib/mesh/guard.h"
#include "lib/mesh/shells.h"
#include "lib/simplify/detail/edge_star.h"
#include "lib/simplify/simplify_params.h"
#include "lib/simplify/waves.h"

/// Plans a single edge collapse: its cost, the place of the merged vertex, and whether it is allowed.
namespace bp {

/// The data that collapses are planned on. It changes only between plans.
struct CollapseGround {
  const HalfEdgeMesh& mesh;
  const FaceTree& tree;
  const SimplifyParams& params;
  const std::vector<Quadric>& quadrics;    ///< per vertex, relative to it
  const std::optional<ShellSense>& sense;  ///< none while collapses only grow the solid
  /// New vertices lie strictly inside this box, which is in the cell and small enough for exact products.
  LatticeBox room{};
  double volume6 = 0;       ///< volume of the mesh at the beginning, times 6; set if growth is limited
  bool only_grows = false;  ///< collapses only grow the solid, so the surface bounds a solid from outside at any time
};

struct CollapsePlan {
  enum class Outcome { refused, too_dear, allowed };
  HalfEdgeId edge = kNoId;
  Outcome outcome = Outcome::refused;
  Refusal refusal = Refusal::none;  ///< reason of the attempt that passed most tests
  double cost = 0;                  ///< lattice units^4, unless refused
  // The fields below are set if the collapse is allowed.
  LatticeCoord position;
  Quadric quadric;                ///< of the merged vertex
  FaceId face = kNoId;            ///< one of the replaced faces
  int128 gain6 = 0;               ///< growth of the volume, times 6
  std::vector<FaceId> swallowed;  ///< faces between the old star and the new one
  EditBoxes boxes;                ///< boxes of the new faces, or one around all faces if parts may be swallowed
};

/// Plans collapses, and changes nothing. Planners of the same data may work at the same time, unless there are limits.
class CollapsePlanner {
 public:
  explicit CollapsePlanner(const CollapseGround& ground);

  /// Returns a lower bound for the cost of collapsing the edge: the minimum of its summed quadrics.
  [[nodiscard]] double lower_bound(HalfEdgeId h) const;

  /// Plans the collapse of an edge: finds the first place that the guard allows. Gives up early if the first place
  /// costs more than `most`.
  void plan(HalfEdgeId h, double most, CollapsePlan& plan);

  std::uint64_t solved = 0;  ///< quadratic programs solved

 private:
  /// A place that has passed every test but the guard.
  struct Candidate {
    LatticeCoord position;
    double cost = 0;  // of the summed quadrics at `position`, lattice units^4
    int attempt = 0;  // number of the attempt
  };
  /// Returns the first place for the merged vertex, from attempt `first_attempt` on; nothing if there is none.
  [[nodiscard]] std::optional<Candidate> solve(HalfEdgeId h, int first_attempt);
  [[nodiscard]] bool may_be_taken(const LatticeCoord& p);
  void fill(const Candidate& candidate, CollapsePlan& plan) const;
  [[nodiscard]] Quadric summed(HalfEdgeId h) const;
  [[nodiscard]] Vec3d midpoint(HalfEdgeId h) const;
  [[nodiscard]] std::optional<Candidate> place_growing(const Quadric& q, const Vec3d& prior);
  [[nodiscard]] std::optional<Candidate> place_free(const Quadric& q, const Vec3d& prior, int first_attempt);
  [[nodiscard]] std::optional<Candidate> place_enclosing(const Quadric& q, const Vec3d& prior, int first_attempt);
  [[nodiscard]] bool acceptable(const LatticeCoord& p, double cost);
  [[nodiscard]] bool edges_are_short(const LatticeCoord& p) const;
  [[nodiscard]] bool adds_little(const LatticeCoord& p) const;
  [[nodiscard]] bool keeps_inside(const LatticeCoord& p);
  [[nodiscard]] bool too_far(double cost) const;
  [[nodiscard]] bool stays_near() const;
  [[nodiscard]] bool leaves_near() const;
  [[nodiscard]] bool is_free(const LatticeCoord& p);
  [[nodiscard]] bool turns_over(const LatticeCoord& p) const;
  [[nodiscard]] const LatticeCoord& origin() const { return star_.origin(); }
  /// Keeps the refusal of the attempt that passed most tests.
  bool refuse(Refusal why) {
    refusal_ = std::max(refusal_, why);
    return false;
  }

  const CollapseGround& ground_;
  const HalfEdgeMesh& mesh_;
  const SimplifyParams& params_;
  Guard guard_;
  Refusal refusal_ = Refusal::none;
  // The fields below belong to the edge that solve() was last called with.
  EdgeStar star_;
  double weight_ = 0;  // area that its quadrics are weighted by
  std::vector<PlaneConstraint> constraints_;
  std::vector<NewFace> new_faces_;
  std::vector<FaceId> replaced_;
  std::vector<Tetrahedron> swept_;
  Blocker blocker_;  // what refused the last place for the edge
  std::vector<LatticeCoord> normals_before_;
  std::vector<FaceId> swallowed_;  // faces between the old star and the new one, then the parts connected to them
};

}  // namespace bp
