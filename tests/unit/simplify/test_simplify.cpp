#include <random>

#include "lib/enclosed/enclosed_voxels.h"
#include "lib/simplify/simplify.h"
#include "lib/surface/repair.h"
#include "lib/surface/surface.h"
#include "lib/tighten/tighten.h"
#include "tests/support/proxy_checks.h"

using namespace bp;
using namespace bp::test;

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
  REQUIRE(proxy.triangles.size() < 4000);  // all pairs are tried
  check_proxy(proxy, box, solids[shape]);
  CHECK(counts.faces_out == proxy.triangles.size());
  TightenCounts tightened;
  const LatticeMesh tight = tighten(proxy, EnclosedVoxels(shelf), {}, tightened);
  CHECK(tightened.volume_after <= tightened.volume_before);
  check_proxy(tight, box, solids[shape]);
  const EnclosedVoxels enclosed(shelf);
  SimplifyParams late;
  late.faces = std::uint64_t(faces) / 2;
  late.dense = false;
  late.enclosed = &enclosed;
  SimplifyCounts more;
  const LatticeMesh coarse = simplify(tight, late, more);
  check_proxy(coarse, box, solids[shape]);
  if (counts.stop == StopReason::faces) CHECK(proxy.triangles.size() <= std::size_t(faces));
}
