#pragma once
#include <algorithm>
#include <vector>

#include "lib/core/indexed_mesh.h"
#include "lib/mesh/lattice_mesh.h"

/// Corners of each triangle, in order: of what was read back, and as they must be.
namespace bp::test {

[[nodiscard]] inline std::vector<TriangleD> soup(const IndexedMesh& mesh) {
  std::vector<TriangleD> all;
  for (const auto& t : mesh.triangles) all.push_back({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
  return all;
}

/// From `origin` on.
[[nodiscard]] inline std::vector<TriangleD> soup(const LatticeMesh& mesh, const Vec3d& origin = {}) {
  std::vector<TriangleD> all;
  for (const auto& t : mesh.triangles) {
    TriangleD d;
    for (std::size_t i = 0; i < 3; ++i) {
      d[i] = mesh.frame.world(mesh.vertices[t[i]]);
      for (std::size_t k = 0; k < 3; ++k) d[i][k] -= origin[k];
    }
    all.push_back(d);
  }
  return all;
}

/// Returns the triangles sorted, each from its lowest corner on in its cyclic order: files may hold them in another
/// order.
[[nodiscard]] inline std::vector<TriangleD> canonical(std::vector<TriangleD> all) {
  for (TriangleD& t : all) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace bp::test
