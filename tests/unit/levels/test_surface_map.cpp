#include <cmath>

#include "lib/levels/level_request.h"
#include "lib/levels/tiles/tile_plan.h"
#include "lib/pass/voxelize/voxelize_pass.h"
#include "tests/catch.h"
#include "tests/support/memory_scene.h"

namespace bp::test {

namespace {

constexpr Cells kCells{64};

/// Two plates of `n` by `n` squares of edge 1, far apart along x.
Triangles plates(int n) {
  Triangles scene;
  for (const double at : {0.0, 900.0}) {
    for (int x = 0; x < n; ++x) {
      for (int z = 0; z < n; ++z) {
        const Vec3d a{at + x, 0, double(z)}, b{at + x + 1, 0, double(z)}, c{at + x, 0, z + 1.0};
        scene.push_back({a, b, c});
        scene.push_back({b, c, Vec3d{at + x + 1, 0, z + 1.0}});
      }
    }
  }
  return scene;
}

struct Mapped {
  SurfaceMap map;
  TilesetPlan plan;
};

Mapped mapped(const Triangles& scene, std::size_t batch) {
  Mapped m;
  MemorySource source(scene, batch);
  for (std::vector<TriangleD> some; source.read(some);) m.map.add(surface_runs(some));
  VoxelizeOptions v;
  v.cell_vox = kCells.edge_vox;
  m.plan = plan_tileset({}, kCells, solid_header(m.map.all().bounds, 1, UpAxis::y, v));
  return m;
}

}  // namespace

TEST_CASE("the work of tiles is where the scene's surface is", "[quick][levels]") {
  const int n = GENERATE(40, 200);
  const Mapped m = mapped(plates(n), GENERATE(1000, 16384));
  CHECK(m.map.all().area == Approx(2.0 * n * n));
  const std::vector<double> work = m.map.work(m.plan, kCells);
  REQUIRE(m.plan.cut.size() > 1);
  for (std::size_t i = 0; i < m.plan.cut.size(); ++i) {
    const CutLevel& level = m.plan.cut[i];
    double left = 0, all = 0;
    for (std::int32_t x = level.cells.first.x; x <= level.cells.last.x; ++x) {
      for (std::int32_t y = level.cells.first.y; y <= level.cells.last.y; ++y) {
        for (std::int32_t z = level.cells.first.z; z <= level.cells.last.z; ++z) {
          const double here = work[level.number_of({x, y, z})];
          all += here;
          if (level.frame.world_origin()[0] + x * 64.0 * level.frame.voxel < 450) left += here;
        }
      }
    }
    CHECK(all == Approx(m.map.all().area / std::pow(level.frame.voxel, 2) * std::pow(0.8, i)));
    CHECK(left == Approx(all / 2).epsilon(0.02));
  }
  CHECK(work.size() == m.plan.jobs());
}

TEST_CASE("a map of a scene with very many runs keeps their area", "[quick][levels]") {
  SurfaceMap map;
  SurfaceRun run;
  run.bounds.add({0, 0, 0});
  run.bounds.add({1, 1, 1});
  run.area = 0.5;
  const std::vector<SurfaceRun> runs(150000, run);
  map.add(runs);
  CHECK(map.all().area == 75000);
  VoxelizeOptions v;
  v.cell_vox = 64;
  const TilesetPlan plan = plan_tileset({}, kCells, solid_header(map.all().bounds, 1. / 128, UpAxis::y, v));
  const std::vector<double> work = map.work(plan, kCells);
  double all = 0;
  for (std::uint64_t i = 0; i < plan.cut.front().cells.count(); ++i) all += work[i];
  CHECK(all == Approx(75000.0 * 128 * 128));
}

}  // namespace bp::test
