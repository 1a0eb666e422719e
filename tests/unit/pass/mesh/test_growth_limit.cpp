// Tests of SimplifyParams::most_growth, the volume that one collapse may add to a proxy around a solid or take from one
// inside it, and of ShapeLimits::room, the box that its vertices may not leave.
#include "lib/enclosed/enclosed_voxels.h"
#include "lib/pass/mesh/detail/proxy_limits.h"
#include "lib/pass/mesh/mesh_pass.h"
#include "lib/pass/mesh/surface_around.h"
#include "lib/simplify/simplify.h"
#include "lib/tighten/tight_proxy.h"
#include "tests/catch.h"
#include "tests/support/voxel_source.h"

using namespace bp;
using namespace bp::test;

namespace {

/// A ball with an arm, where far planes meet.
bool lollipop(VoxelCoord p) {
  const std::int32_t x = p.x - 12, y = p.y - 12, z = p.z - 12;
  return x * x + y * y + z * z < 50 || (x >= 0 && x < 14 && y * y < 3 && z * z < 3);
}

/// A plate on 36 legs, which a mesh of few faces cannot show separately.
bool table(VoxelCoord p) {
  const bool leg = p.x % 8 < 2 && p.y % 8 < 2 && p.z >= 4;
  return p.x < 42 && p.y < 42 && p.z >= 4 && p.z < 40 && (p.z >= 36 || leg);
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

TEST_CASE("collapses add no more to a proxy, and take no more from one inside, than most_growth", "[quick][pass]") {
  const bool inside = GENERATE(false, true);
  const Start start = start_of(inside);
  const EnclosedVoxels enclosed(*start.enclosed);
  const double before = double(volume6_of(start.mesh)) / double(kVolume6OfVoxel), most_growth = 0.2;
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
    Outcome out{double(volume6_of(mesh)) / double(kVolume6OfVoxel) - before, 0, counts.refused[Refusal::growth]};
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

TEST_CASE("the room around a surface suits its extents, and few faces", "[quick][pass]") {
  const LatticeBox box{{0, -640, 6400}, {6400, 640, 12800}};
  const LatticeBox many = room_around(box, 1000), few = room_around(box, 20);
  CHECK(many.min == LatticeCoord{-64 - 160, -640 - 64 - 32, 6400 - 64 - 160});
  CHECK(many.max == LatticeCoord{6400 + 64 + 160, 640 + 64 + 32, 12800 + 64 + 160});
  CHECK(few.max.x - box.max.x > 6400 / 8);  // an icosahedron around a ball
  CHECK(few.max.x - box.max.x < 6400 / 3);
}

TEST_CASE("proxies draw no spikes where thin parts end, however few faces are asked for", "[quick][pass]") {
  const bool tighten = GENERATE(true, false);
  VoxelSource source({{0, 0, 0}, {64, 64, 64}}, table);
  MeshParams params;
  params.faces = {60};
  params.tighten = tighten;
  MeshCounts counts;
  const LatticeMesh proxy = mesh_stream(source, memory_context(), params, counts).front();
  const LatticeBox around = box_of(proxy.vertices);
  CAPTURE(proxy.triangles.size(), around.min.z, around.max.z);
  constexpr double kExtent = 36;
  const double beyond = (0.02 + 5.0 / double(proxy.triangles.size())) * kExtent;
  CHECK(double(around.min.z) / kLatticePerVoxel > 4 - 1 - beyond);
  CHECK(double(around.max.z) / kLatticePerVoxel < 40 + 1 + beyond);
}

TEST_CASE("a ball has proxies of as few faces as are asked for", "[quick][pass]") {
  const auto ball = [](VoxelCoord p) {
    const std::int32_t x = p.x - 32, y = p.y - 32, z = p.z - 32;
    return x * x + y * y + z * z < 400;
  };
  MeshParams params;
  params.faces = {GENERATE(4u, 6u, 8u, 12u, 20u)};
  VoxelSource source({{0, 0, 0}, {64, 64, 64}}, ball);
  MeshCounts counts;
  CHECK(mesh_stream(source, memory_context(), params, counts).front().triangles.size() == params.faces[0]);
}
