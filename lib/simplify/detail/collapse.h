#pragma once
#include <optional>
#include <vector>

#include "lib/simplify/detail/collapse_planner.h"

/// Single edge collapses of a mesh. The orders in which they are taken are in bulk_order.h and collapse_order.h.
namespace bp {

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
  [[nodiscard]] const SimplifyParams& params() const { return ground_.params; }
  [[nodiscard]] const Quadric& quadric(VertexId v) const { return quadric_[v]; }
  /// Which shells have turned; null while collapses only grow the solid: they leave none that has.
  [[nodiscard]] const ShellSense* sense() const { return sense_ ? &*sense_ : nullptr; }

  /// What planners plan on.
  [[nodiscard]] const CollapseGround& ground() const { return ground_; }
  void count_solved(CollapsePlanner& planner);  ///< adds its count, and clears it

  /// Makes what was planned on the mesh as it is, or before others whose stars and boxes have nothing in common with
  /// its own. The merged vertex is from(plan.edge); it is dead if what it belonged to was inside other parts then, and
  /// was erased. False, and nothing is done, if those others have changed what its shell bounds.
  bool take(const CollapsePlan& plan);

 private:
  void erase_part(FaceId f);

  HalfEdgeMesh& mesh_;
  SimplifyCounts& counts_;
  FaceTree tree_;
  std::vector<Quadric> quadric_;  // per vertex, about its position
  std::optional<ShellSense> sense_;
  CollapseGround ground_;
};

}  // namespace bp
