#pragma once
#include <optional>
#include <set>
#include <vector>

#include "lib/quads/cell_quads.h"
#include "lib/tighten/fan_fit.h"
#include "lib/tighten/joint_fit.h"
#include "lib/tighten/proxy_editor.h"

namespace bp {

/// Moves the vertices of a cage, each together with its mirror image, as far as its editor allows.
class Skin {
 public:
  Skin(const CellQuads& cage, HalfEdgeMesh& mesh, ProxyEditor& editor, const std::optional<MirrorPlane>& plane);

  /// Evens the vertices out and moves them inwards.
  void relax();
  /// Moves the vertices outwards by `share` times their mean edge.
  void swell(double share);
  /// Moves each vertex to where the solid is smallest.
  void fit();
  /// Moves all vertices together to where the solid is smaller. Vertices that move one at a time jam, since a quad that
  /// rests on three points holds its corners.
  void fit_together();

  /// Moves v by `by`, or by the largest of its halves, quarters ... that is allowed.
  bool go(VertexId v, Vec3d by);

 private:
  template <class Step>
  void for_each(const Step& step);
  [[nodiscard]] Vec3d to_mean(VertexId v, double& edge) const;
  void relax(VertexId v);
  void push(VertexId v, double inwards);
  void fit(VertexId v);
  [[nodiscard]] Vec3d joint_shift(VertexId v) const;
  double gather(VertexId v, const Vec3d& shift);
  bool move(VertexId v, LatticeCoord to);

  const CellQuads& cage_;
  HalfEdgeMesh& mesh_;
  ProxyEditor& editor_;
  const std::optional<MirrorPlane>& plane_;
  std::vector<std::set<VertexId>> near_;  // per vertex: its neighbours along edges of quads
  FanFit fit_;
  JointFit joint_;
};

}  // namespace bp
