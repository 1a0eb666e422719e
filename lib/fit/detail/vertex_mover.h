#pragma once
#include <vector>

#include "lib/enclosed/enclosed.h"
#include "lib/mesh/face_tree.h"
#include "lib/mesh/guard.h"
#include "lib/mesh/shells.h"
#include "lib/simplify/shape_limits.h"

/// Moves vertices freely, outwards or inwards, while the mesh stays embedded and no shell turns inside out.
namespace bp {

class VertexMover {
 public:
  /// `shape`: limits that every move keeps; `near`: what its reach is measured from; may be null.
  VertexMover(HalfEdgeMesh& mesh, const ShapeLimits& shape, const Enclosed* near)
      : mesh_(mesh),
        tree_(mesh),
        guard_(mesh, tree_),
        sense_(mesh),
        room_(intersect(mesh.room(), shape.room)),
        edge_limit_(shape.edge_limit),
        limits_(shape.limits),
        near_(shape.reach > 0 ? near : nullptr),
        reach_(shape.reach) {}

  /// Moves v to q, or half or a quarter of the way. A move that would let faces meet, turn over or become needles, or
  /// turn a shell inside out, is not made. True if v has moved.
  bool draw(VertexId v, const LatticeCoord& q);

  /// Flips the edge under the same conditions. True if it was.
  bool flip(HalfEdgeId h);

 private:
  bool try_move(VertexId v, const LatticeCoord& q);
  [[nodiscard]] bool stays_near() const { return near_ == nullptr || near_->is_near(star_, reach_); }

  HalfEdgeMesh& mesh_;
  FaceTree tree_;
  Guard guard_;
  ShellSense sense_;
  LatticeBox room_;
  EdgeLimit edge_limit_;
  StepLimits* limits_;
  const Enclosed* near_;
  double reach_;
  std::vector<NewFace> star_;
  std::vector<FaceId> replaced_;
};

}  // namespace bp
