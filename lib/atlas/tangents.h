#pragma once
#include <array>
#include <vector>

#include "lib/mesh/shaded_mesh.h"

namespace bp {

/// Returns, for each copy of a vertex of a mesh with a texture, the direction in which u rises, as MikkTSpace
/// (Mikkelsen 2008) defines it. It is a unit vector orthogonal to the normal. The fourth number is 1, or -1 if the
/// image is mirrored: cross(normal, tangent) times it points up in the image. O(n).
[[nodiscard]] std::vector<std::array<float, 4>> tangents_of(const LatticeMesh& mesh, const ShadedMesh& drawn);

}  // namespace bp
