#include "lib/core/error.h"
#include "lib/pass/mesh/mesh_pass.h"
#include "lib/pass/mesh/surface_around.h"
#include "lib/surface/surface.h"
#include "tests/unit/pass/mesh/dumbbell.h"

using namespace bp;
using namespace bp::test;

TEST_CASE("levels have their faces, enclose what is meshed, and each encloses the level before", "[quick][pass]") {
  const bool tighten = GENERATE(true, false);
  MeshParams params;
  params.faces = {1500, 400, 100, 40};
  params.tighten = tighten;
  MeshCounts counts;
  const std::vector<LatticeMesh> levels = mesh(params, counts);
  REQUIRE(levels.size() == 4);
  REQUIRE(counts.levels.size() == 4);
  std::vector<TriangleD> inner = points_inside();
  for (std::size_t i = 0; i < levels.size(); ++i) {
    CAPTURE(i, counts.levels[i].stopped_by);
    CHECK(levels[i].triangles.size() <= params.faces[i]);
    CHECK(levels[i].triangles.size() >=
          params.faces[i] - 2 - (tighten ? params.faces[i] / 50 : 0));  // some are needless
    CHECK((counts.levels[i].stopped_by == "faces" || (tighten && counts.levels[i].stopped_by == "least-volume")));
    check(levels[i], &inner);
    inner = world_triangles(levels[i]);
  }
}

TEST_CASE("levels whose numbers do not fall are refused", "[quick][pass]") {
  MeshParams params;
  params.faces = GENERATE(std::vector<std::uint64_t>{100, 100}, std::vector<std::uint64_t>{100, 50, 60});
  MeshCounts counts;
  CHECK_THROWS_AS(mesh(params, counts), Error);
}

TEST_CASE("numbers below zero are refused", "[quick][pass]") {
  VoxelSource source(kBox, dumbbell);
  MeshParams params;
  if (GENERATE(false, true)) {
    params.mode = MeshMode::inside;
    source.header().fill = FillMode::inside;
  }
  const int which = GENERATE(0, 1, 2);
  (which == 0 ? params.error_world : which == 1 ? params.volume_ratio : params.edge_factor) = -1;
  MeshCounts counts;
  CHECK_THROWS_AS(mesh_stream(source, memory_context(), params, counts), Error);
}

TEST_CASE("the surface around a mesh strictly encloses it, whatever the voxels", "[quick][pass]") {
  MeshParams params;
  params.faces = {120};
  MeshCounts counts;
  const LatticeMesh inner = mesh(params, counts)[0];
  const auto shelf = memory_shelves()();
  const GridFrame frame = voxels_around(inner, GENERATE(0.7, 1.0, 3.3), memory_shelves(), {}, *shelf);
  const LatticeMesh around = dense_surface(*shelf, frame);
  const std::vector<TriangleD> triangles = world_triangles(inner);
  check(around, &triangles);
}

TEST_CASE("a chain of levels is the same for every memory, and what waits goes to the store", "[quick][pass]") {
  MeshParams params;
  params.faces = {400, 200, 60};
  MeshCounts counts;
  const std::vector<LatticeMesh> roomy = mesh(params, counts);
  std::uint64_t put = 0, held = 0;
  PassContext context = memory_context();
  context.pieces.waiting_bytes = 0;
  context.pieces.work_bytes = std::uint64_t(32) << 20;
  context.pieces.make_scratch = [&] { return std::make_unique<MemoryStore>(put, held); };
  const std::vector<LatticeMesh> tight = mesh(params, counts, dumbbell, context);
  CHECK(put > 0);
  REQUIRE(tight.size() == roomy.size());
  for (std::size_t i = 0; i < roomy.size(); ++i) {
    CHECK(tight[i].vertices == roomy[i].vertices);
    CHECK(tight[i].triangles == roomy[i].triangles);
  }
}

TEST_CASE("a stream that does not hold what the mode needs is refused", "[quick][pass]") {
  VoxelSource source(kBox, dumbbell);
  MeshParams params;
  params.mode = GENERATE(MeshMode::inside, MeshMode::bounding);
  if (params.mode == MeshMode::bounding) source.header().fill = FillMode::inside;
  MeshCounts counts;
  CHECK_THROWS_AS(mesh_stream(source, memory_context(), params, counts), Error);
}

TEST_CASE("a closing without the voxels that must stay inside is refused", "[quick][pass]") {
  VoxelSource source(
      kBox, [](VoxelCoord) { return false; }, dumbbell);
  MeshParams params;
  params.enclose = Enclose::input;
  params.faces = {40};
  params.error_world = GENERATE(0.0, 3.0);
  MeshCounts counts;
  CHECK_THROWS_AS(mesh_stream(source, memory_context(), params, counts), Error);
}
