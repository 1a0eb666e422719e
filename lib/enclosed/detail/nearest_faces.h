#pragma once
#include <span>
#include <vector>

#include "lib/core/vec3.h"
#include "lib/mesh/face_tree.h"

namespace bp {

/// For each point, relative to `origin`, the face of the mesh that it is nearest to, the first of several; kNoId if
/// none is within `reach`. Parallel. Points near each other share the search in the tree.
[[nodiscard]] std::vector<FaceId> nearest_faces(std::span<const Vec3d> points, const LatticeCoord& origin,
                                                const HalfEdgeMesh& mesh, const FaceTree& tree, double reach);

}  // namespace bp
