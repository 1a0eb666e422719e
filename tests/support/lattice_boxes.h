#pragma once
#include "lib/mesh/half_edge_mesh.h"

namespace bp::test {

/// An axis-aligned box as 12 triangles, outward, or inward.
inline void add_box(LatticeMesh& mesh, const LatticeBox& box, bool outward = true) {
  const auto first = std::uint32_t(mesh.vertices.size());
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.push_back(
        {i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z});
  }
  const std::uint32_t quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                     {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& q : quads) {
    for (int i = 1; i < 3; ++i) {
      Triangle t{first + q[0], first + q[i], first + q[i + 1]};
      if (!outward) std::swap(t[1], t[2]);
      mesh.triangles.push_back(t);
    }
  }
}

/// A tetrahedron whose base is level, around (x, y) of `apex`, `reach` wide and at height `base`; outward if the apex
/// is above it. Returns the vertex at the apex.
inline VertexId add_tetrahedron(LatticeMesh& mesh, const LatticeCoord& apex, std::int64_t base, std::int64_t reach) {
  const auto first = std::uint32_t(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), {{apex.x - reach, apex.y - reach, base},
                                             {apex.x + reach, apex.y - reach, base},
                                             {apex.x, apex.y + reach, base},
                                             apex});
  mesh.triangles.insert(mesh.triangles.end(), {{first, first + 2, first + 1},
                                               {first, first + 1, first + 3},
                                               {first + 1, first + 2, first + 3},
                                               {first + 2, first, first + 3}});
  return first + 3;
}

}  // namespace bp::test
