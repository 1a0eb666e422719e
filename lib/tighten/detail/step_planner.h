#pragma once
#include <optional>
#include <vector>

#include "lib/tighten/fan_fit.h"
#include "lib/tighten/proxy_editor.h"

namespace bp {

/// A planned change at a vertex or an edge.
struct StepPlan {
  VertexId vertex = kNoId;
  HalfEdgeId edge = kNoId;
  std::optional<LatticeCoord> to;  ///< where the vertex goes
  bool flips = false;              ///< the edge is flipped
  std::vector<Vec3d> learned;      ///< contact points, relative to the vertex
  EditBoxes boxes;                 ///< of the new faces; empty if nothing changes

  [[nodiscard]] bool changes_mesh() const { return to.has_value() || flips; }
  void make(ProxyEditor& editor) const;
};

/// Plans where a vertex can go, or whether an edge can be flipped, without changing anything. Planners of one editor
/// may work at the same time.
class StepPlanner {
 public:
  /// `any_limits`: the proxy has limits, which may refuse a step aside, so shorter steps straight inwards are tried,
  /// too.
  StepPlanner(const ProxyEditor& editor, bool any_limits);

  /// Plans to move v by x, by a half or by a quarter of it: the first that is allowed.
  void approach(VertexId v, const Vec3d& x, StepPlan& plan);
  /// Plans to move v to the place where its star has the least volume over its contact points, or a part of the way.
  void find_place(VertexId v, StepPlan& plan);
  /// Plans to move v by x, if that lowers the volume.
  void go_back(VertexId v, const Vec3d& x, StepPlan& plan);
  void flip(HalfEdgeId h, StepPlan& plan);

  /// Adds to the editor's counts what its checks counted.
  void count(ProxyEditor& editor);

 private:
  void begin(VertexId v, StepPlan& plan);
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
  StepPlan* plan_ = nullptr;
};

}  // namespace bp
