#pragma once
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "lib/exact/triangle_intersection.h"
#include "lib/mesh/half_edge_mesh.h"
#include "tests/catch.h"
#include "tests/support/voxel_source.h"

/// Checks of a proxy that share nothing with the code that makes it but the predicates.
namespace bp::test {

inline void fill_shelf(MemoryShelf& shelf, const VoxelBox& box, const Solid& solid) {
  store_voxels(bits_of(box, solid), shelf);
}

/// Counts intersections by trying all pairs.
inline int self_intersections(const LatticeMesh& m) {
  int pairs = 0;
  for (std::size_t i = 0; i < m.triangles.size(); ++i) {
    for (std::size_t j = i + 1; j < m.triangles.size(); ++j) {
      pairs += triangles_meet_beyond_shared(m.vertices.data(), m.triangles[i], m.triangles[j]);
    }
  }
  return pairs;
}

/// Parity of the faces above the centre of a voxel; the ray is shifted off the lattice of centres' symmetries by
/// counting exactly.
inline bool inside(const LatticeMesh& m, LatticeCoord p) {
  int winding = 0;
  for (const auto& t : m.triangles) {
    const LatticeCoord &a = m.vertices[t[0]], &b = m.vertices[t[1]], &c = m.vertices[t[2]];
    const auto crosses = [&](const LatticeCoord& s, const LatticeCoord& e) {  // upward 1, downward -1, half-open in y
      return (s.y <= p.y) == (e.y <= p.y) ? 0 : s.y <= p.y ? 1 : -1;
    };
    // Half-open rule in the xy shadow: sum over the edges that cross y = p.y to the right of p.
    int turn = 0;
    const LatticeCoord* v[4] = {&a, &b, &c, &a};
    for (int i = 0; i < 3; ++i) {
      const int sign = crosses(*v[i], *v[i + 1]);
      if (sign == 0) continue;
      const int side = orient2d(*v[i], *v[i + 1], p, 2);
      if ((sign > 0 && side > 0) || (sign < 0 && side < 0)) turn += sign;
    }
    if (turn != 0 && orient3d(a, b, c, p) * turn < 0) winding += turn;
  }
  return winding > 0;
}

/// A second opinion on connectivity, by code that shares nothing with ours.
inline bool manifold_by_open_mesh(const LatticeMesh& m) {
  OpenMesh::TriMesh_ArrayKernelT<> kernel;
  std::vector<OpenMesh::VertexHandle> handles;
  for (const LatticeCoord& v : m.vertices) handles.push_back(kernel.add_vertex({float(v.x), float(v.y), float(v.z)}));
  for (const auto& t : m.triangles) {
    if (!kernel.add_face(handles[t[0]], handles[t[1]], handles[t[2]]).is_valid()) return false;
  }
  for (const auto e : kernel.edges()) {
    if (kernel.is_boundary(e)) return false;
  }
  for (const auto v : kernel.vertices()) {
    if (kernel.is_isolated(v) || !kernel.is_manifold(v)) return false;
  }
  return true;
}

inline void check_proxy(const LatticeMesh& proxy, const VoxelBox& box, const Solid& solid) {
  REQUIRE_NOTHROW(HalfEdgeMesh(proxy));  // closed, oriented, 2-manifold
  CHECK(manifold_by_open_mesh(proxy));
  CHECK(self_intersections(proxy) == 0);
  int outside = 0;
  for_each(box, [&](VoxelCoord p) {
    if (solid(p)) outside += !inside(proxy, {64 * p.x + 31, 64 * p.y + 29, 64 * p.z + 27});
  });
  CHECK(outside == 0);
}

}  // namespace bp::test
