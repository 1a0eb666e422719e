#pragma once
#include "lib/enclosed/contact_points.h"
#include "lib/enclosed/enclosed.h"
#include "lib/mesh/guard.h"
#include "lib/mesh/shells.h"
#include "lib/simplify/refusal.h"
#include "lib/simplify/shape_limits.h"

/// Changes of a proxy, each taken only if the proxy stays embedded and keeps inside what must stay inside, both decided
/// exactly (docs/bounding.md, "Tightening"), and if it makes no needle and no edge too long.
namespace bp {

struct EditCounts {
  std::uint64_t tries = 0;
  Refusals refused;
  std::uint64_t beyond_reach = 0;  ///< of those refused for their growth
};

class ProxyEditor {
 public:
  /// `mesh`: closed, 2-manifold, embedded, enclosing, or a cell's part of such a mesh (regions.h); it and `enclosed`
  /// must outlive the editor.
  /// `limits`: kept by every change.
  ProxyEditor(HalfEdgeMesh& mesh, const Enclosed& enclosed, const ShapeLimits& limits);

  [[nodiscard]] const HalfEdgeMesh& mesh() const { return mesh_; }
  [[nodiscard]] const ContactPoints& contacts() const { return contacts_; }
  [[nodiscard]] const EditCounts& counts() const { return counts_; }

  /// Each returns true if the change was taken.
  [[nodiscard]] bool move(VertexId v, const LatticeCoord& to);
  [[nodiscard]] bool collapse(HalfEdgeId h, const LatticeCoord& to);  ///< the merged vertex keeps the id from(h)
  [[nodiscard]] bool flip(HalfEdgeId h);

  /// What must stay inside and stood in the way of the change refused last, in the coordinates of contacts(); null if
  /// something else did.
  [[nodiscard]] const Blocker* blocker() const { return blocked_ ? &blocker_ : nullptr; }

  /// More contact points, relative to v, near its faces.
  void learn(VertexId v, std::span<const Vec3d> points);

  /// Erases those that have turned. The last step: nothing may be changed after it.
  void erase_turned_shells();
  /// Erases the shells that bound nothing (shells.h): a part over which another one has moved may have moved on,
  /// through what only that one keeps inside. For a whole mesh. The last step.
  void erase_inner_shells();
  [[nodiscard]] const ShellSense& sense() const { return sense_; }  ///< of the changes so far
  /// Flipping a convex edge cuts a tetrahedron off the solid; flipping another adds one.
  [[nodiscard]] bool is_convex(HalfEdgeId h) const;
  [[nodiscard]] bool inwards() const { return inwards_; }  ///< faces_inwards() of the mesh as it was given

  /// True where a step failed by its reach since it was loosened last, which it is now.
  [[nodiscard]] bool loosen();

  void refresh() { tree_.rebuild(); }  ///< boxes only grow with the changes; after many of them fresh ones pay

 private:
  void begin();
  void add_old_face(const LatticeCoord& a, const LatticeCoord& b, const LatticeCoord& c, const LatticeCoord& to);
  [[nodiscard]] bool shape_is_fine();
  [[nodiscard]] bool cuts_off_contacts(const LatticeCoord& a, const LatticeCoord& b, const LatticeCoord& u,
                                       const LatticeCoord& w) const;
  [[nodiscard]] bool keeps_enclosed();
  [[nodiscard]] bool stays_near();
  [[nodiscard]] bool fan_is_fine(const LatticeCoord& apex);
  [[nodiscard]] bool is_free(bool free);
  void update_around(VertexId apex);

  HalfEdgeMesh& mesh_;
  const Enclosed& enclosed_;
  EdgeLimit edge_limit_;
  StepLimits* limits_;
  const bool inwards_;
  const LatticeBox room_;  // for new vertices
  const double first_reach_;
  double reach_;
  FaceTree tree_;
  Guard guard_;
  ShellSense sense_;
  ContactPoints contacts_;
  EditCounts counts_;
  std::uint64_t beyond_reach_before_ = 0;  // by the reach before
  // Of the change at hand:
  std::vector<NewFace> faces_;
  std::vector<FaceId> replaced_, around_;
  std::vector<Tetrahedron> swept_;
  double least_quality_ = 1;  // of the faces replaced
  LatticeBox star_;           // around them
  Blocker blocker_;
  bool blocked_ = false;
};

}  // namespace bp
