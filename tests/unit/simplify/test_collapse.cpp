#include <cmath>
#include <random>

#include "lib/mesh/lattice_geometry.h"
#include "lib/mesh/shells.h"
#include "lib/simplify/detail/bulk_order.h"
#include "lib/simplify/simplify.h"
#include "lib/surface/repair.h"
#include "lib/surface/surface.h"
#include "tests/support/proxy_checks.h"

using namespace bp;
using namespace bp::test;

namespace {

/// A ball in a cloud of single voxels.
LatticeMesh dusty_surface(unsigned seed, double density) {
  std::mt19937 random{seed};
  std::bernoulli_distribution occupied(density);
  MemoryShelf shelf;
  fill_shelf(shelf, {{0, 0, 0}, {30, 30, 30}}, [&](VoxelCoord p) {
    const int x = p.x - 15, y = p.y - 15, z = p.z - 15;
    return x * x + y * y + z * z < 60 || occupied(random);
  });
  repair_contacts(shelf);
  return dense_surface(shelf, {});
}

std::uint64_t refused(const SimplifyCounts& c) {
  std::uint64_t all = 0;
  c.refused.for_each([&](Refusal, const char*, std::uint64_t count) { all += count; });
  return all;
}

}  // namespace

TEST_CASE("solutions far away, or none, are rounded to points that the predicates can take", "[quick][meshing]") {
  constexpr std::int64_t far = std::int64_t(1) << 39;
  CHECK(rounded({1.5, -1.5, -0.4}) == LatticeCoord{2, -2, 0});
  CHECK(rounded({1e300, -1e300, std::nan("")}) == LatticeCoord{far, -far, -far});
}

TEST_CASE("what a collapse swallows is erased at once, and nothing meets", "[quick][meshing]") {
  const unsigned seed = GENERATE(range(0u, 4u));
  HalfEdgeMesh mesh(dusty_surface(seed, 0.01));
  const SimplifyParams params;
  SimplifyCounts counts;
  Collapser collapser(mesh, {}, params, counts);
  collapse_bulk(collapser, {kFirstBound, kLastBound}, 0);
  CHECK(mesh.face_count() < 3000);
  CHECK(self_intersections(mesh.compact(GridFrame{})) == 0);
  CHECK(erase_inner_shells(mesh) == 0);
}

TEST_CASE("where nothing is left to merge, the counts name a reason for every edge", "[quick][meshing]") {
  SimplifyParams params;
  params.faces = 1;
  SimplifyCounts counts;
  const LatticeMesh proxy = simplify(dusty_surface(7, 0.02), params, counts);
  CHECK(counts.stop == StopReason::nothing_left);
  CHECK(refused(counts) == proxy.triangles.size() / 2 * 3);
  CHECK(counts.refused[Refusal::error] == 0);
}

TEST_CASE("an error that no further collapse keeps is named as the reason", "[quick][meshing]") {
  SimplifyParams params;
  params.error_vox = 0.2;
  SimplifyCounts counts;
  const LatticeMesh proxy = simplify(dusty_surface(7, 0), params, counts);
  CHECK(counts.stop == StopReason::error);
  CHECK(counts.refused[Refusal::error] > 0);
  CHECK(refused(counts) == proxy.triangles.size() / 2 * 3);
}

TEST_CASE("a cell's collapses leave its rim as it was and stay strictly inside", "[quick][meshing]") {
  MemoryShelf shelf;  // a ball around the common corner of eight bricks
  fill_shelf(shelf, {{-20, -20, -20}, {20, 20, 20}},
             [](VoxelCoord p) { return p.x * p.x + p.y * p.y + p.z * p.z < 300; });
  repair_contacts(shelf);
  const Piece piece = ShelfSurface(shelf, {}).piece({0, -1, 0});
  HalfEdgeMesh mesh(piece.vertices, piece.triangles, piece.cell);
  const SimplifyParams params;
  SimplifyCounts counts;
  Collapser collapser(mesh, {}, params, counts);
  collapse_bulk(collapser, {kFirstBound, 1e4 * kFirstBound}, 0);
  CHECK(mesh.face_count() < piece.triangles.size() / 2);
  int rim = 0;
  for (VertexId v = 0; v < mesh.vertex_capacity(); ++v) {
    if (mesh.locked(v)) {
      ++rim;
      CHECK(mesh.vertex_alive(v));
      CHECK(mesh.position(v) == piece.vertices[v]);
    } else if (mesh.vertex_alive(v) && mesh.position(v) != piece.vertices[v]) {
      CHECK(piece.cell.holds_inside(mesh.position(v)));
    }
  }
  CHECK(rim > 60);
}
