#pragma once
#include <optional>
#include <vector>

#include "lib/tighten/fan_fit.h"
#include "lib/tighten/proxy_editor.h"

namespace bp {

/// Finds where a vertex can go, or whether an edge can be flipped, and changes nothing. Planners of one editor may work
/// at the same time.
class StepPlanner {
 public:
  /// `any_limits`: shorter ways are tried straight inwards, too: limits may mind a step aside.
  StepPlanner(const ProxyEditor& editor, bool any_limits);

  /// As far along x as is allowed of the whole way, a half, a quarter.
  void approach(VertexId v, const Vec3d& x);
  /// To where the star has the least volume over its contact points, or a part of the way.
  void find_place(VertexId v);
  /// Along x, if that lowers the volume.
  void go_back(VertexId v, const Vec3d& x);
  void flip(HalfEdgeId h);

  // What was planned last:
  [[nodiscard]] const LatticeBox& seen() const { return check_.seen; }  ///< around all that was read
  /// Makes it. True if the mesh or its contact points changed: then `box` is around what did.
  [[nodiscard]] bool make(ProxyEditor& editor, LatticeBox& box);
  [[nodiscard]] bool changes_mesh() const { return to_.has_value() || flips_; }
  [[nodiscard]] VertexId vertex() const { return vertex_; }
  [[nodiscard]] HalfEdgeId edge() const { return edge_; }

 private:
  void begin(VertexId v);
  void begin_star(VertexId v);
  double gather_rim();
  void gather_points();
  [[nodiscard]] bool try_move(const Vec3d& x);
  [[nodiscard]] bool learns(const Vec3d& x);
  void shorten(const Vec3d& x, double reach);
  [[nodiscard]] bool worth_trying(const Vec3d& x) const;
  [[nodiscard]] Vec3d place() const;

  const ProxyEditor& editor_;
  const HalfEdgeMesh& mesh_;
  const bool any_limits_;
  EditCheck check_;
  FanFit fit_;
  VertexId vertex_ = kNoId;
  HalfEdgeId edge_ = kNoId;
  std::optional<LatticeCoord> to_;  // where the vertex goes
  bool flips_ = false;              // the edge
  std::vector<Vec3d> learned_;      // contact points, relative to the vertex
};

}  // namespace bp
