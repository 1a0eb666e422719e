#include <cmath>

#include "lib/core/parallel.h"
#include "lib/geometry/near_surface.h"
#include "lib/pass/mesh/detail/proxy_limits.h"
#include "lib/pass/mesh/surface_around.h"
#include "lib/simplify/surface_tree.h"
#include "lib/surface/repair.h"
#include "tests/support/proxy_checks.h"
#include "tests/support/voxel_source.h"

using namespace bp;
using namespace bp::test;

namespace {

const VoxelBox kManyBricks{{-70, -40, -20}, {80, 70, 75}};  // 3 x 3 x 3 bricks, around the origin
constexpr double kError = 3;

const Solid kSolids[] = {
    [](VoxelCoord p) { return std::hypot(p.x * 0.5, p.y - 10.0, p.z - 25.0) < 30 + (p.x & 1); },
    [](VoxelCoord p) { return std::abs(p.x + 2 * p.y - 3 * p.z) < 5; },  // a slanted sheet
    [](VoxelCoord p) { return (p.x & 63) < 2 || (p.y & 63) == 63; },     // walls along the cells' sides
    [](VoxelCoord p) { return p.x % 9 < 4 && p.y % 11 < 5 && p.z % 7 < 3; },
};

LatticeMesh by_cells(const SurfaceSource& surface, ProxyLimits& limits, SimplifyCounts& counts) {
  SimplifyParams params;
  params.limits = &limits;
  Piece piece = simplified_surface(surface, params, {0, std::pow(limits.error_lattice(), 4)}, counts);
  LatticeMesh mesh;
  mesh.vertices = std::move(piece.vertices);
  mesh.triangles = std::move(piece.triangles);
  return mesh;
}

}  // namespace

TEST_CASE("cells that are simplified at the same time keep a bound on distances", "[quick][pass]") {
  const int shape = GENERATE(range(0, 4));
  MemoryShelf shelf;
  fill_shelf(shelf, kManyBricks, kSolids[shape]);
  repair_contacts(shelf);
  const ShelfSurface surface(shelf, {});
  const TriangleBvh tree(world_triangles(dense_surface(shelf, {})));
  const auto with_threads = [&](int threads) {
    const ThreadLimit limit(threads);
    ProxyLimits limits({.error_world = kError}, {}, &tree);
    SimplifyCounts counts;
    LatticeMesh mesh = by_cells(surface, limits, counts);
    CAPTURE(shape, counts.faces_flat, mesh.triangles.size());
    CHECK(mesh.triangles.size() < counts.faces_flat * 9 / 10);
    return mesh;
  };
  const LatticeMesh one = with_threads(1), three = with_threads(3);
  CHECK(one.vertices == three.vertices);
  CHECK(one.triangles == three.triangles);
  NearSurface near(tree, 1, 1 << 12);
  for (const TriangleD& t : world_triangles(one)) REQUIRE(near.holds(t, 1.02 * kError));
  check_proxy(one, kManyBricks, [&](VoxelCoord p) { return (p.x + 2 * p.y + 3 * p.z) % 7 == 0 && kSolids[shape](p); });
}

TEST_CASE("a bound on the volume is of the surface as a whole", "[quick][pass]") {
  const TriangleBvh tree({{Vec3d{0, 0, 0}, Vec3d{1, 0, 0}, Vec3d{0, 1, 0}}});
  CHECK(ProxyLimits({.error_world = 1}, {}, &tree).for_part() != nullptr);
  CHECK(ProxyLimits({.error_world = 1, .volume_world = 9}, {}, &tree).for_part() == nullptr);
}
