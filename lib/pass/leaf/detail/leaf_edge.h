#pragma once
#include <utility>
#include <vector>

#include "lib/pass/leaf/detail/leaf_mesh.h"

/// Foresees what the collapse of an edge of a leaf's mesh does. The edge's ends are the points u and v.
namespace bp {

/// Returns the third corners of the faces at an edge, in order, each once.
[[nodiscard]] std::vector<LeafMesh::Index> thirds_of(const LeafMesh& mesh, LeafMesh::Index u, LeafMesh::Index v);

/// Returns whether a collapse joins nothing: the ends have no common neighbours but the third corners of their faces,
/// or those where faces of both come to lie on each other; and no edge between two borders goes.
[[nodiscard]] bool keeps_parts(const LeafMesh& mesh, LeafMesh::Index u, LeafMesh::Index v);

/// The corners at both ends of an edge: pairs that a face has, and others.
struct EdgeCorners {
  std::vector<std::pair<LeafMesh::Index, LeafMesh::Index>> pairs;
  std::vector<LeafMesh::Index> others_u, others_v;
  bool holds_u = false, holds_v = false;  ///< a seam goes on from the end elsewhere, so that this must not move
};
[[nodiscard]] EdgeCorners corners_of_edge(const LeafMesh& mesh, LeafMesh::Index u, LeafMesh::Index v);

/// Returns what becomes of the corners if the edge collapses into a point at this share of the way from u to v.
[[nodiscard]] std::vector<LeafMesh::Change> changes_of(const LeafMesh& mesh, const EdgeCorners& corners, double share);

/// Returns whether a face that is left after the collapse into a point at `to` would turn over, in the scene or in its
/// image, or lose its area. `whole`: the leaf that the mesh was made from.
[[nodiscard]] bool turns_faces(const LeafMesh& mesh, const SceneLeaf& whole, LeafMesh::Index u, LeafMesh::Index v,
                               const Vec3d& to, const std::vector<LeafMesh::Change>& changes);

}  // namespace bp
