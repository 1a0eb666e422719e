#include <map>
#include <random>

#include "lib/device/cpu/cpu_backend.h"
#include "lib/grid/shelf_stream.h"
#include "lib/pass/close/cell_closing.h"
#include "lib/pass/close/close_pass.h"
#include "tests/catch.h"
#include "tests/support/memory_results.h"
#include "tests/support/voxel_source.h"

namespace bp::test {

namespace {

Backends backends() {
  Backends all;
  for (int i = 0; i < 2; ++i) all.push_back(std::make_unique<CpuBackend>());
  return all;
}

/// Shells and crumbs over several cells of 128; some shells are closed, so that there are cavities.
Solid blobs(unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::array<int, 4>> balls;
  for (int i = 0; i < 9; ++i)
    balls.push_back({int(random() % 260) - 20, int(random() % 120), int(random() % 150), 8 + int(random() % 40)});
  return [balls](VoxelCoord p) {
    for (const auto& [x, y, z, r] : balls) {
      const int d = (p.x - x) * (p.x - x) + (p.y - y) * (p.y - y) + (p.z - z) * (p.z - z);
      if (d <= r * r && d > (r - 3) * (r - 3) && (r % 3 == 0 || p.z < z + r / 2)) return true;
    }
    return false;
  };
}

std::map<BrickCoord, BrickBits> bricks_of_shelf(const BrickShelf& shelf) {
  std::map<BrickCoord, BrickBits> all;
  for (const BrickCoord c : shelf.coords()) shelf.get(c, all[c]);
  return all;
}

}  // namespace

TEST_CASE("closing by cells gives the voxels of closing as a stream, from the store as well", "[quick][pass][lod]") {
  const VoxelBox box{{-30, 0, 0}, {270, 130, 160}};
  VoxelSource source(box, blobs(unsigned(GENERATE(1, 2, 3))));
  const double scale = GENERATE(1.5, 6.0, 40.0);
  const bool keep_cavities = GENERATE(false, true);
  CAPTURE(scale, keep_cavities);
  MemoryShelf solid, expected;
  ShelfSink to_solid(&solid);
  for (Brick brick; source.read(brick);) to_solid.write(brick);
  Backends all = backends();
  {
    ScaleField field;
    field.base = scale;
    CloseOptions o;
    o.keep_cavities = keep_cavities;
    o.context.make_shelf = memory_shelves();
    ShelfSource again(source.header(), solid, nullptr, ShelfSource::Keep::all);
    ShelfSink sink(nullptr, &expected);
    close_stream(again, sink, all, field, {}, o);
  }
  MemoryResults store;
  CellClosing o;
  o.cells = Cells{128};
  o.keep_cavities = keep_cavities;
  o.context.memory.bytes = GENERATE(std::uint64_t(1) << 30, std::uint64_t(64) << 20);
  o.context.results = &store;
  std::vector<std::uint64_t> kept;
  for (int i = 0; i < 3; ++i) {
    if (i == 2)
      for (auto& [key, bytes] : store.results) bytes = bytes.substr(0, bytes.size() / 2);  // no bricks any more
    MemoryShelf closing;
    const CellClosingCounts counts = close_cells(source.header(), solid, all, scale, o, closing);
    CHECK(bricks_of_shelf(closing) == bricks_of_shelf(expected));
    kept.push_back(counts.kept);
    if (i == 1) CHECK(counts.kept == counts.cells);
  }
  CHECK(kept[0] < kept[1]);  // empty cells are all alike
  CHECK(kept[2] < kept[1]);
}

}  // namespace bp::test
