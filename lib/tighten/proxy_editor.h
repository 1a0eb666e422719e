#pragma once
#include <initializer_list>
#include <optional>

#include "lib/mesh/shells.h"
#include "lib/simplify/waves.h"
#include "lib/tighten/contact_forces.h"
#include "lib/tighten/edit_check.h"

/// Changes a proxy. Each change is made only if the proxy stays embedded and still encloses everything that it must,
/// both decided exactly (docs/bounding.md, "Tightening"), and if it makes no needle and no edge too long.
namespace bp {

class ProxyEditor {
 public:
  /// `mesh`: closed, 2-manifold, embedded and enclosing, or the part of such a mesh in a cell (regions.h). It and
  /// `enclosed` must outlive the editor. `limits`: kept by every change.
  ProxyEditor(HalfEdgeMesh& mesh, const Enclosed& enclosed, const ShapeLimits& limits);

  [[nodiscard]] const HalfEdgeMesh& mesh() const { return mesh_; }
  [[nodiscard]] const ContactPoints& contacts() const { return contacts_; }
  [[nodiscard]] ContactForces& forces() { return forces_; }  ///< the forces of contacts() on the mesh
  [[nodiscard]] const EditCounts& counts() const { return check_.counts; }

  /// These return true if the change was made.
  [[nodiscard]] bool move(VertexId v, const LatticeCoord& to);
  [[nodiscard]] bool collapse(HalfEdgeId h, const LatticeCoord& to);  ///< the merged vertex keeps the id from(h)
  [[nodiscard]] bool flip(HalfEdgeId h);
  /// Removes the vertex opposite(h), which has three faces, and flips the edge of h, which is left. Its two faces then
  /// meet in an edge from the vertex's third neighbour.
  [[nodiscard]] bool cut(HalfEdgeId h);

  /// Returns EditCheck::blocker() of the last refused change.
  [[nodiscard]] const Blocker* blocker() const { return check_.blocker(); }

  /// Returns whether several checks may plan changes at the same time, and whether changes may be made in waves.
  [[nodiscard]] bool has_planners() const { return bp::has_planners(mesh_, proxy_.limits != nullptr); }
  [[nodiscard]] bool has_waves() const { return bp::has_waves(mesh_, proxy_.limits != nullptr); }
  /// Returns a check of this proxy for another thread, which may be used while the proxy does not change. A change that
  /// it allows can be made later, if nothing has changed in its way (waves.h). Not for a proxy with limits.
  [[nodiscard]] EditCheck new_check() const { return EditCheck(proxy_); }
  void make_move(VertexId v, const LatticeCoord& to);
  void make_collapse(HalfEdgeId h, const LatticeCoord& to);
  void make_flip(HalfEdgeId h);
  /// Lists contact points with the faces that are nearest now. Call it after every wave of changes. If only flips use
  /// the points in between, once after many waves suffices: an old list can only refuse a flip. Parallel.
  void settle_points();
  void settle_points_of_many();  ///< the same, after changes that neither made nor removed faces
  void add(const EditCounts& counts) { check_.counts += counts; }  ///< adds the counts of another check

  /// Adds contact points near the faces of v, given relative to v.
  void learn(VertexId v, std::span<const Vec3d> points);

  /// Erases the shells that have turned inside out. Nothing may be changed afterwards.
  void erase_turned_shells();
  /// Erases the shells that bound nothing (shells.h): if a shell has moved over another part, that part may have moved
  /// on through things that only the shell still encloses. Only for a whole mesh. Nothing may be changed afterwards.
  void erase_inner_shells();
  /// Tells which shells the changes so far have turned.
  [[nodiscard]] const ShellSense& sense() const { return sense_; }
  /// Returns whether the edge is convex: flipping it cuts a tetrahedron off the solid; flipping another edge adds one.
  [[nodiscard]] bool is_convex(HalfEdgeId h) const;
  [[nodiscard]] bool inwards() const { return inwards_; }  ///< faces_inwards() of the mesh that was given

  /// Makes the reach longer, if a step has failed because of it since the last call. Returns whether it did.
  [[nodiscard]] bool loosen();

  /// Begins to record changes, or begins anew. Until end_undo(), undo() takes back all changes since then, in the time
  /// that they took. Only without contact points, since their lists are not recorded; sense() does not change back.
  void begin_undo();
  void end_undo() { undo_.reset(); }
  void undo();

  /// Rebuilds the tree: its boxes only grow with changes, so fresh ones pay after many.
  void refresh() { tree_.rebuild(); }

 private:
  /// Faces whose contact points must be listed again: with the faces of a star and those beyond its rim, or with each
  /// other if there is no apex.
  struct Unsettled {
    std::vector<FaceId> from;
    VertexId apex = kNoId;
  };
  struct Settler {
    ContactPoints::Scratch scratch;
    std::vector<FaceId> around;
  };
  void save(std::initializer_list<VertexId> vertices);
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
  std::uint64_t beyond_reach_before_ = 0;  // counts.beyond_reach at the last loosen()
  std::optional<HalfEdgeMesh::Undo> undo_;
  std::vector<FaceId> replaced_, around_;  // faces of the change that is being made
  // The first unsettled_count_ of these are in use: the changes since points were last settled.
  std::vector<Unsettled> unsettled_;
  std::size_t unsettled_count_ = 0;
  WaveWorkers<Settler> settlers_;
};

}  // namespace bp
