#pragma once
#include <span>
#include <vector>

#include "lib/core/vec3.h"
#include "lib/mesh/face_tree.h"

namespace bp {

/// Returns, for each point relative to `origin`, the nearest face of the mesh (the first of equals), or kNoId if none
/// is within `reach`. Parallel. Points near each other share the search in the tree.
[[nodiscard]] std::vector<FaceId> nearest_faces(std::span<const Vec3d> points, const LatticeCoord& origin,
                                                const HalfEdgeMesh& mesh, const FaceTree& tree, double reach);

}  // namespace bp
