#pragma once
#include <optional>
#include <vector>

#include "lib/simplify/detail/collapse_planner.h"

/// Single edge collapses of a mesh. The orders in which they are taken are in bulk_order.h and collapse_order.h.
namespace bp {

/// Returns a quadric per vertex, relative to it: the planes of its faces, weighted by their areas.
[[nodiscard]] std::vector<Quadric> quadrics_of(const HalfEdgeMesh& mesh);
[[nodiscard]] std::vector<Quadric> quadrics_of(const Piece& piece);

class Collapser {
 public:
  /// Keeps references. `quadrics`: per vertex, relative to it; empty: made from the faces. Vertices on the boundary of
  /// the mesh's cell are locked, and new vertices stay strictly inside the cell: changes in one cell can meet nothing
  /// of the changes in others (docs/bounding.md).
  Collapser(HalfEdgeMesh& mesh, std::vector<Quadric> quadrics, const SimplifyParams& params, SimplifyCounts& counts);

  [[nodiscard]] HalfEdgeMesh& mesh() { return mesh_; }
  [[nodiscard]] const HalfEdgeMesh& mesh() const { return mesh_; }
  [[nodiscard]] const SimplifyParams& params() const { return ground_.params; }
  [[nodiscard]] const Quadric& quadric(VertexId v) const { return quadric_[v]; }
  /// Returns the record of shells that have turned inside out; null while collapses only grow the solid, since then no
  /// shell turns.
  [[nodiscard]] const ShellSense* sense() const { return sense_ ? &*sense_ : nullptr; }

  /// Returns the data that planners read.
  [[nodiscard]] const CollapseGround& ground() const { return ground_; }
  void count_solved(CollapsePlanner& planner);  ///< adds its count, and clears it

  /// Makes a planned collapse, on the mesh as it was planned on, or after other collapses whose stars and boxes have
  /// nothing in common with its own. The merged vertex is from(plan.edge); it is dead if its part came to lie inside
  /// other parts and was erased. Returns false, and changes nothing, if earlier collapses have changed what its shell
  /// bounds.
  bool take(const CollapsePlan& plan);

 private:
  void erase_part(FaceId f);

  HalfEdgeMesh& mesh_;
  SimplifyCounts& counts_;
  FaceTree tree_;
  std::vector<Quadric> quadric_;  // per vertex, relative to it
  std::optional<ShellSense> sense_;
  CollapseGround ground_;
};

}  // namespace bp
