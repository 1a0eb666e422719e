#include <cmath>
#include <cstdint>
#include <random>

#include "lib/grid/cells.h"
#include "lib/grid/clip.h"
#include "lib/volume/boundary_runs.h"
#include "lib/volume/reduce.h"
#include "tests/catch.h"
#include "tests/support/voxel_source.h"

namespace bp::test {

namespace {

const VoxelBox kBox{{-70, -10, 3}, {100, 80, 140}};

std::unique_ptr<BrickShelf> random_shelf(unsigned seed) {
  std::mt19937 random(seed);
  auto shelf = std::make_unique<MemoryShelf>();
  store_voxels(bits_of(kBox, [&](VoxelCoord) { return random() % 3 == 0; }), *shelf);
  return shelf;
}

template <class F>
void for_each_voxel(const VoxelBox& box, const F& f) {
  for (VoxelCoord p = box.min; p.z < box.max.z; ++p.z)
    for (p.y = box.min.y; p.y < box.max.y; ++p.y)
      for (p.x = box.min.x; p.x < box.max.x; ++p.x) f(p);
}

}  // namespace

TEST_CASE("frames aligned to cells stay so through all reductions, until the scene is in one cell",
          "[quick][grid][lod]") {
  const double reach = GENERATE(10.0, 440.0, 450.0, 5000.0, 100000.0);
  const Vec3d place = GENERATE(Vec3d{0, 0, 0}, Vec3d{-1e5 + 0.3, 7.7e6, -513.25});
  const std::int32_t edge = GENERATE(64, 128, 512);
  Bounds3d bounds;
  bounds.add(place);
  bounds.add({place[0] + reach, place[1] + reach / 3, place[2] + reach});
  const Cells cells{edge};
  GridFrame frame = aligned_to_cells(make_frame(bounds, 0.9), bounds, edge);
  for (int level = 0; level < 40; ++level) {
    const VoxelBox box = voxel_bounds(frame, bounds);
    CAPTURE(reach, edge, level, box.min.x, box.max.x);
    for (const std::int64_t o : frame.origin) CHECK(o % std::min(kBrickEdge, edge / 2) == 0);
    for (int i = 0; i < 3; ++i) CHECK(box.min[i] >= 1);
    const CellSpan span = cells_spanned(cells, box);
    if (span.count() == 1 && span.first == CellCoord{}) return;  // fine cells may hold it, too, by chance
    const GridFrame coarse = reduced(frame);
    for (std::size_t i = 0; i < 3; ++i) CHECK(2 * coarse.origin[i] == frame.origin[i]);
    frame = coarse;
  }
  FAIL("never in the first cell");
}

TEST_CASE("division rounds down and up over the whole range of an integer", "[quick][grid]") {
  constexpr std::int32_t least = INT32_MIN, most = INT32_MAX;
  for (const std::int32_t a : {least, least + 1, -65, -64, -63, -1, 0, 1, 63, 64, 65, most - 1, most}) {
    for (const std::int32_t b : {1, 3, 64}) {
      CHECK(floor_div(a, b) == std::int32_t(std::floor(double(a) / b)));
      CHECK(ceil_div(a, b) == std::int32_t(std::ceil(double(a) / b)));
    }
  }
}

TEST_CASE("cells of a span have numbers from 0 on, in their order", "[quick][grid][lod]") {
  const Cells cells{128};
  const CellSpan span = cells_spanned(cells, VoxelBox{{-1, 0, 127}, {128, 129, 385}});
  CHECK(span.first == CellCoord{-1, 0, 0});
  CHECK(span.last == CellCoord{0, 1, 3});
  REQUIRE(span.count() == 16);
  std::vector<CellCoord> all;
  for (std::int32_t x = -1; x <= 0; ++x)
    for (std::int32_t y = 0; y <= 1; ++y)
      for (std::int32_t z = 0; z <= 3; ++z) all.push_back({x, y, z});
  CHECK(std::is_sorted(all.begin(), all.end()));
  for (std::size_t i = 0; i < all.size(); ++i) CHECK(span.index(all[i]) == i);
  CHECK(cells_spanned(cells, BrickBox{{0, 0, 0}, {2, 2, 3}}).count() == 2);
}

TEST_CASE("a clipped solid has the voxels in the box and no others", "[quick][grid][lod]") {
  const auto shelf = random_shelf(5);
  const VoxelBox box = GENERATE(VoxelBox{{-3, 0, 5}, {65, 64, 7}}, VoxelBox{{-64, -64, 0}, {64, 64, 128}},
                                VoxelBox{{-200, -200, -200}, {-150, 300, 300}});
  const auto part = clipped(*shelf, box, memory_shelves());
  BitBox all(kBox.grown(3)), some(kBox.grown(3));
  load_voxels(*shelf, all);
  load_voxels(*part, some);
  for_each_voxel(kBox.grown(3), [&](VoxelCoord p) {
    if (some.test(p) != (all.test(p) && box.contains(p))) FAIL("voxel " << p.x << " " << p.y << " " << p.z);
  });
  std::uint64_t length = 0, count = 0;
  for (const VoxelRun& run : runs_of(*shelf, box)) length += std::uint64_t(run.length);
  for_each_voxel(intersect(box, kBox), [&](VoxelCoord p) { count += all.test(p); });
  CHECK(length == count);
}

TEST_CASE("a box is full if every voxel of it is", "[quick][grid][lod]") {
  MemoryShelf shelf;
  store_voxels(bits_of(kBox, [](VoxelCoord p) { return p != VoxelCoord{10, 20, 30}; }), shelf);
  CHECK(is_full(shelf, {{11, -10, 3}, {100, 80, 140}}));
  CHECK(is_full(shelf, {{-70, -10, 3}, {10, 80, 140}}));
  CHECK_FALSE(is_full(shelf, {{10, 20, 30}, {11, 21, 31}}));
  CHECK_FALSE(is_full(shelf, {{90, 0, 100}, {101, 10, 110}}));
}

TEST_CASE("the boundary layer holds the voxels of the boundary's runs", "[quick][grid][lod]") {
  const auto shelf = random_shelf(7);
  MemoryShelf layer;
  boundary_layer(*shelf, layer);
  const Boundary boundary = boundary_of(*shelf);
  BitBox voxels(kBox);
  load_voxels(layer, voxels);
  std::uint64_t length = 0, faces = 0;
  for (const VoxelRun& run : boundary.runs) {
    length += std::uint64_t(run.length);
    for (std::int32_t i = 0; i < run.length; ++i) CHECK(voxels.test({run.first.x + i, run.first.y, run.first.z}));
  }
  for (const BrickCoord c : shelf->coords()) faces += boundary_faces(*shelf, c);
  CHECK(length == voxels.count());
  CHECK(faces == boundary.faces);
}

}  // namespace bp::test
