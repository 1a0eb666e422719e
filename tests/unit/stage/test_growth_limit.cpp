// Of SimplifyParams::most_growth: what one collapse may add to a proxy around a solid, or take from one inside it.
#include "lib/meshing/enclosed_voxels.h"
#include "lib/meshing/simplify.h"
#include "lib/stage/proxy_limits.h"
#include "lib/stage/surface_around.h"
#include "tests/catch.h"
#include "tests/support/voxel_source.h"

using namespace bp;
using namespace bp::test;

namespace {

constexpr double kVolume6OfVoxel = 6.0 * kLatticePerVoxel * kLatticePerVoxel * kLatticePerVoxel;

/// A ball with an arm, where far planes meet.
bool lollipop(VoxelCoord p) {
  const std::int32_t x = p.x - 12, y = p.y - 12, z = p.z - 12;
  return x * x + y * y + z * z < 50 || (x >= 0 && x < 14 && y * y < 3 && z * z < 3);
}

struct Start {
  std::unique_ptr<BrickShelf> enclosed = memory_shelves()();
  LatticeMesh mesh;
};

Start start_of(bool inside) {
  const auto shelf = memory_shelves()();
  store_voxels(bits_of({{0, 0, 0}, {32, 32, 32}}, lollipop), *shelf);
  Start start;
  if (inside) {
    start.mesh = inward_surface(*shelf, GridFrame{}, memory_shelves(), *start.enclosed);
  } else {
    store_voxels(bits_of({{0, 0, 0}, {32, 32, 32}}, lollipop), *start.enclosed);
    start.mesh = dense_surface(*start.enclosed, GridFrame{});
  }
  return start;
}

}  // namespace

TEST_CASE("collapses add no more to a proxy, and take no more from one inside, than most_growth", "[quick][stage]") {
  const bool inside = GENERATE(false, true);
  const Start start = start_of(inside);
  const EnclosedVoxels enclosed(*start.enclosed);
  const double before = double(volume6_of(start.mesh)) / kVolume6OfVoxel, most_growth = 0.2;
  REQUIRE((before < 0) == inside);
  struct Outcome {
    double growth;  // inside: of what surrounds
    double bound;   // the sum over all collapses
    std::uint64_t refused;
  };
  const auto outcome = [&](double limit) {
    SimplifyParams params;
    params.dense = false;
    params.enclosed = &enclosed;
    params.most_growth = limit;
    params.faces = 8;
    SimplifyCounts counts;
    const LatticeMesh mesh = simplify(start.mesh, params, counts);
    Outcome out{double(volume6_of(mesh)) / kVolume6OfVoxel - before, 0, counts.refused_growth};
    for (std::size_t f = start.mesh.triangles.size(); f > mesh.triangles.size(); f -= 2)
      out.bound += most_growth * std::abs(before) / double(f);
    return out;
  };
  const Outcome limited = outcome(most_growth), free = outcome(0);
  CAPTURE(inside, before, limited.growth, limited.bound, limited.refused, free.growth, free.bound);
  CHECK(limited.growth > 0);
  CHECK(limited.growth <= limited.bound);
  CHECK(limited.refused > 0);
  CHECK(free.growth > free.bound);
  CHECK(free.refused == 0);
}
