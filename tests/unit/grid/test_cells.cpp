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

Bounds3d bounds_at(const Vec3d& low, const Vec3d& size) {
  Bounds3d bounds;
  bounds.add(low);
  bounds.add({low[0] + size[0], low[1] + size[1], low[2] + size[2]});
  return bounds;
}

/// Returns the frame of a scene with voxels of 0.5.
GridFrame frame_of(const Bounds3d& bounds, std::int32_t edge, UpAxis up = UpAxis::z) {
  return aligned_to_cells(make_frame(bounds, 0.5, up), bounds, edge);
}

/// How far above a cut plane of a level a point lies, in cells.
double above_plane(const GridFrame& frame, int axis, double at, std::int32_t edge, int level) {
  const double cells = (at / frame.voxel - double(frame.origin[std::size_t(axis)])) / std::ldexp(edge, level);
  return cells - std::floor(cells);
}

}  // namespace

TEST_CASE("frames aligned to cells stay so through all reductions, until the scene is in one cell",
          "[quick][grid][lod]") {
  const double reach = GENERATE(10.0, 440.0, 450.0, 5000.0, 100000.0);
  const Vec3d place = GENERATE(Vec3d{0, 0, 0}, Vec3d{-1e5 + 0.3, 7.7e6, -513.25});
  const std::int32_t edge = GENERATE(64, 128, 192, 512, 2048);
  const UpAxis up = GENERATE(UpAxis::y, UpAxis::z, UpAxis::minus_x, UpAxis::minus_z);
  const Bounds3d bounds = bounds_at(place, {reach, reach / 3, reach});
  const Cells cells{edge};
  GridFrame frame = aligned_to_cells(make_frame(bounds, 0.9, up), bounds, edge);
  for (const std::int64_t o : frame.origin)
    CHECK(o % 2 == 0);  // also of a scene in one cell: the tree has one above it
  const int upright = to_y_up(up).axis[1];
  VoxelBox box = voxel_bounds(frame, bounds);
  for (int level = 0; level < 40; ++level) {
    CAPTURE(reach, edge, int(up), level, box.min.x, box.max.x);
    for (int i = 0; i < 3; ++i) {
      if (i == upright) continue;
      CHECK(frame.origin[std::size_t(i)] % std::min(kBrickEdge, edge / 2) == 0);
      CHECK(box.min[i] >= 1);
    }
    const CellSpan span = cells_spanned(cells, box);
    if (span.count() == 1 && span.first == CellCoord{}) return;  // fine cells may hold it, too, by chance
    for (int i = 0; i < 3; ++i) CHECK(box.min[i] >= 1);          // a closing stays in the cells
    const GridFrame coarse = reduced(frame);
    for (std::size_t i = 0; i < 3; ++i) CHECK(2 * coarse.origin[i] == frame.origin[i]);
    frame = coarse;
    box = halved(box);
  }
  FAIL("never in the first cell");
}

TEST_CASE("wherever the ground lies, no level is cut closely above it", "[quick][grid][lod]") {
  const double ground = GENERATE(-0.01, 0.0, 1.0, 127.99, -64.01, 4711.3);
  const std::int32_t edge = GENERATE(64, 128, 256, 512);
  const double side =
      edge == 64 ? 300 : GENERATE(300.0, 524.0, 704.0);  // else all of its planes lie at multiples of it
  const UpAxis up = GENERATE(UpAxis::x, UpAxis::y, UpAxis::z, UpAxis::minus_x, UpAxis::minus_y, UpAxis::minus_z);
  const AxisTurn turn = to_y_up(up);
  const std::size_t axis = turn.axis[1];
  const double sign = turn.negative[1] ? -1 : 1;
  Vec3d low{-411.7, 52.1, 8047.3}, size{side, side, side};
  size[axis] = 15;
  low[axis] = sign > 0 ? ground : -ground - size[axis];
  const GridFrame frame = frame_of(bounds_at(low, size), edge, up);
  for (int level = 0; edge * 0.5 * std::ldexp(1, level) < side; ++level) {
    const double above = above_plane(frame, int(axis), sign * ground, edge, level);
    CAPTURE(ground, edge, side, int(up), level, above);
    CHECK(std::ldexp(edge, level) * (sign > 0 ? above : 1 - above) > 1);
    CHECK((sign > 0 ? 1 - above : above) > 0.2);
  }
}

TEST_CASE("a scene that changes a little keeps its cells", "[quick][grid][lod]") {
  const std::int32_t edge = GENERATE(128, 256, 512);
  const GridFrame frame = frame_of(bounds_at({-0.01, -300, -0.01}, {524, 500, 40}), edge);
  CHECK(frame == frame_of(bounds_at({0, -300, 0}, {524, 500, 40}), edge));
  CHECK(frame == frame_of(bounds_at({-0.01, -300, -0.02}, {524, 500, 40.01}), edge));
  CHECK(frame == frame_of(bounds_at({-5.25, -305, -0.41}, {529.24, 505, 40.4}), edge));  // by 1 % of each side
  CHECK(frame == frame_of(bounds_at({-0.01, -300, -0.01}, {529, 505, 90}), edge));
  CHECK(frame == frame_of(bounds_at({3, -296, 1}, {500, 470, 30}), edge));
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
