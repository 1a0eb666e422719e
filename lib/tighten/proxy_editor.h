#pragma once
#include "lib/mesh/shells.h"
#include "lib/simplify/waves.h"
#include "lib/tighten/contact_forces.h"
#include "lib/tighten/edit_check.h"

/// Changes of a proxy, each taken only if the proxy stays embedded and keeps inside what must stay inside, both decided
/// exactly (docs/bounding.md, "Tightening"), and if it makes no needle and no edge too long.
namespace bp {

class ProxyEditor {
 public:
  /// `mesh`: closed, 2-manifold, embedded, enclosing, or a cell's part of such a mesh (regions.h); it and `enclosed`
  /// must outlive the editor.
  /// `limits`: kept by every change.
  ProxyEditor(HalfEdgeMesh& mesh, const Enclosed& enclosed, const ShapeLimits& limits);

  [[nodiscard]] const HalfEdgeMesh& mesh() const { return mesh_; }
  [[nodiscard]] const ContactPoints& contacts() const { return contacts_; }
  [[nodiscard]] ContactForces& forces() { return forces_; }  ///< of contacts() on the mesh
  [[nodiscard]] const EditCounts& counts() const { return check_.counts; }

  /// Each returns true if the change was taken.
  [[nodiscard]] bool move(VertexId v, const LatticeCoord& to);
  [[nodiscard]] bool collapse(HalfEdgeId h, const LatticeCoord& to);  ///< the merged vertex keeps the id from(h)
  [[nodiscard]] bool flip(HalfEdgeId h);
  /// Takes the vertex opposite(h) out, which has three faces, and flips the edge of h, which is left: its two faces
  /// meet in an edge from the vertex's third neighbour.
  [[nodiscard]] bool cut(HalfEdgeId h);

  /// As EditCheck::blocker(), of the change refused last.
  [[nodiscard]] const Blocker* blocker() const { return check_.blocker(); }

  /// Changes may be made in waves.
  [[nodiscard]] bool has_waves() const { return bp::has_waves(mesh_, proxy_.limits != nullptr); }
  /// Checks on other threads: of this proxy, while it does not change. What they allow can be made later, if nothing
  /// has changed in its way (waves.h). Not for a proxy with limits.
  [[nodiscard]] EditCheck new_check() const { return EditCheck(proxy_); }
  void make_move(VertexId v, const LatticeCoord& to);
  void make_collapse(HalfEdgeId h, const LatticeCoord& to);
  void make_flip(HalfEdgeId h);
  /// Lists contact points with the faces that are nearest now; due after every wave of changes, or, where only flips
  /// ask for them meanwhile, which old ones may refuse, once after many. Parallel.
  void settle_points();
  void settle_points_of_many();  ///< the same, after changes that made and took no faces
  void add(const EditCounts& counts) { check_.counts += counts; }  ///< of another check

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
  /// Faces whose points are to be listed anew: with those of a star and beyond its rim, or with each other.
  struct Unsettled {
    std::vector<FaceId> from;
    VertexId apex = kNoId;
  };
  struct Settler {
    ContactPoints::Scratch scratch;
    std::vector<FaceId> around;
  };
  Unsettled& replace(std::span<const FaceId> faces, const LatticeCoord& apex);
  void settle(const Unsettled& some, Settler& settler);

  HalfEdgeMesh& mesh_;
  EdgeLimit edge_limit_;
  const bool inwards_;
  const double first_reach_;
  double reach_;
  FaceTree tree_;
  ShellSense sense_;
  ContactPoints contacts_;
  ContactForces forces_;
  EditedProxy proxy_;
  EditCheck check_;
  std::uint64_t beyond_reach_before_ = 0;  // by the reach before
  std::vector<FaceId> replaced_, around_;  // of the change at hand
  std::vector<Unsettled> unsettled_;       // the first of them, by changes since points were settled last
  std::size_t unsettled_count_ = 0;
  WaveWorkers<Settler> settlers_;
};

}  // namespace bp
