#include "lib/device/cpu/cpu_backend.h"
#include "lib/levels/tiles/tile_pyramid.h"
#include "tests/catch.h"
#include "tests/support/memory_results.h"
#include "tests/support/voxelized.h"

using namespace bp;
using namespace bp::test;

TEST_CASE("before tiles are made, it is told how much of them is not kept", "[quick][pass][lod][cache]") {
  MemoryResults results;
  Backends backends;
  backends.push_back(std::make_unique<CpuBackend>());
  const auto left = [&](double height) {  // of the last of three boxes, each in a cell of its own
    Triangles scene;
    for (int i = 0; i < 3; ++i) add_box(scene, {128.0 * i + 40, 40, 3}, {128.0 * i + 80, 80, i == 2 ? height : 40});
    Voxelized solid = voxelized(scene, 1, 128);
    PyramidOptions options;
    options.cells = Cells{128};
    options.context.make_shelf = memory_shelves();
    options.context.results = &results;
    TilePyramid pyramid(solid.header, std::move(solid.shelf), backends, options);
    TileParams params;
    params.scale_world = 2;
    pyramid.add_level(params);
    TileJobs jobs(pyramid.tasks(), pyramid.context());
    for (std::size_t i = 0; i < jobs.count(); ++i) {
      std::optional<KeptTile> tile;
      if (!jobs.get(i, {}, tile)) continue;
      REQUIRE(tile);
      CHECK(tile->content == "tile");
      CHECK(tile->measures.faces > 0);
    }
    const double share = jobs.share_left();
    for (const std::size_t i : jobs.left()) {
      KeptTile tile{{}, "tile"};
      REQUIRE(jobs.make(i, pyramid.context(), tile.measures));
      jobs.put(i, tile);
    }
    return share;
  };
  CHECK(left(40) == 1);
  CHECK(left(40) == 0);
  const double changed = left(30);
  CHECK(changed > 0.2);
  CHECK(changed < 0.4);
}
