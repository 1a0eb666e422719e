#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <functional>
#include <random>

#include "lib/core/triangle_intersection.h"
#include "lib/meshing/half_edge_mesh.h"
#include "lib/meshing/repair.h"
#include "lib/meshing/simplify.h"
#include "lib/meshing/surface.h"
#include "lib/meshing/tighten.h"
#include "tests/catch.h"
#include "tests/support/memory_shelf.h"

using namespace bp;
using bp::test::MemoryShelf;

namespace {

using Solid = std::function<bool(VoxelCoord)>;

void fill_shelf(MemoryShelf& shelf, const VoxelBox& box, const Solid& solid) {
  BitBox bits(voxels_of(bricks_of(box)));
  for (int z = box.min.z; z < box.max.z; ++z) {
    for (int y = box.min.y; y < box.max.y; ++y) {
      for (int x = box.min.x; x < box.max.x; ++x) {
        if (solid({x, y, z})) bits.set({x, y, z});
      }
    }
  }
  store_voxels(bits, shelf);
}

/// By trying all pairs.
int self_intersections(const LatticeMesh& m) {
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
bool inside(const LatticeMesh& m, LatticeCoord p) {
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
bool manifold_by_open_mesh(const LatticeMesh& m) {
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

void check_proxy(const LatticeMesh& proxy, const VoxelBox& box, const Solid& solid) {
  REQUIRE_NOTHROW(HalfEdgeMesh(proxy));  // closed, oriented, 2-manifold
  CHECK(manifold_by_open_mesh(proxy));
  CHECK(manifold_by_open_mesh(proxy));
  CHECK(self_intersections(proxy) == 0);
  int outside = 0;
  for (int z = box.min.z; z < box.max.z; ++z) {
    for (int y = box.min.y; y < box.max.y; ++y) {
      for (int x = box.min.x; x < box.max.x; ++x) {
        if (solid({x, y, z})) outside += !inside(proxy, {64 * x + 31, 64 * y + 29, 64 * z + 27});
      }
    }
  }
  CHECK(outside == 0);
}

}  // namespace

TEST_CASE("the dense surface of any voxel set is closed, manifold and exact after repair", "[quick][meshing]") {
  const int seed = GENERATE(range(0, 6));
  const double density = GENERATE(0.1, 0.5, 0.9);
  std::mt19937 random{unsigned(seed)};
  std::bernoulli_distribution occupied(density);
  MemoryShelf shelf;
  const VoxelBox box{{58, -3, 60}, {70, 9, 70}};  // across brick borders
  fill_shelf(shelf, box, [&](VoxelCoord) { return occupied(random); });
  BitBox before(voxels_of(bricks_of(box)));
  load_voxels(shelf, before);
  const std::uint64_t added = repair_contacts(shelf);
  BitBox after(before.box());
  load_voxels(shelf, after);
  CHECK(after.count() == before.count() + added);
  const LatticeMesh surface = dense_surface(shelf, {});
  REQUIRE_NOTHROW(HalfEdgeMesh(surface));
  std::int64_t volume6 = 0;
  for (const auto& t : surface.triangles) {
    volume6 +=
        std::int64_t(orient3d_value({0, 0, 0}, surface.vertices[t[0]], surface.vertices[t[1]], surface.vertices[t[2]]));
  }
  CHECK(volume6 == std::int64_t(after.count()) * 6 * 64 * 64 * 64);
}

TEST_CASE("a simplified proxy encloses its voxels and does not meet itself", "[quick][meshing]") {
  const int shape = GENERATE(range(0, 4));
  const int faces = GENERATE(1000, 200, 40, 4);
  CAPTURE(shape, faces);
  const VoxelBox box{{0, 0, 0}, {40, 40, 40}};
  const Solid solids[] = {
      [](VoxelCoord p) {  // two balls that nearly touch: a pinch
        const auto d = [&](int cx) {
          return (p.x - cx) * (p.x - cx) + (p.y - 20) * (p.y - 20) + (p.z - 20) * (p.z - 20);
        };
        return d(11) < 81 || d(30) < 81;
      },
      [](VoxelCoord p) {
        return p.z == 7 || (p.z == 9 && p.x < 30) || (p.x == 12 && p.y == 14);
      },                  // thin sheets, one gap apart
      [](VoxelCoord p) {  // a torus
        const double r = std::hypot(p.x - 20.0, p.y - 20.0) - 13;
        return r * r + (p.z - 20.0) * (p.z - 20.0) < 16;
      },
      [](VoxelCoord p) {
        return (p.x * 7 + p.y * 3 + p.z * 5) % 11 < 4 && p.x < 20 && p.y < 20 && p.z < 12;
      },  // a sponge
  };
  MemoryShelf shelf;
  fill_shelf(shelf, box, solids[shape]);
  repair_contacts(shelf);
  SimplifyParams params;
  params.faces = std::uint64_t(faces);
  SimplifyCounts counts;
  const LatticeMesh proxy = simplify(dense_surface(shelf, {}), params, counts);
  CAPTURE(counts.faces_in, counts.faces_flat, counts.faces_out);
  if (proxy.triangles.size() < 4000) check_proxy(proxy, box, solids[shape]);
  CHECK(counts.faces_out == proxy.triangles.size());
  TightenCounts tightened;
  const LatticeMesh tight = tighten(proxy, EnclosedVoxels(shelf), {}, tightened);
  CHECK(tightened.volume_after <= tightened.volume_before);
  if (tight.triangles.size() < 4000) check_proxy(tight, box, solids[shape]);
  const EnclosedVoxels enclosed(shelf);
  SimplifyParams late;
  late.faces = std::uint64_t(faces) / 2;
  late.dense = false;
  late.enclosed = &enclosed;
  SimplifyCounts more;
  const LatticeMesh coarse = simplify(tight, late, more);
  if (coarse.triangles.size() < 4000) check_proxy(coarse, box, solids[shape]);
  if (counts.stop == StopReason::faces) CHECK(proxy.triangles.size() <= std::size_t(faces));
}
