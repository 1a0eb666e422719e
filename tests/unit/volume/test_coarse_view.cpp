#include <cmath>

#include "lib/geometry/triangle_totals.h"
#include "lib/volume/coarse_view.h"
#include "tests/catch.h"

using namespace bp;

namespace {

Brick brick_at(BrickCoord c) {
  Brick b;
  b.coord = c;
  b.fill = BrickFill::mixed;
  return b;
}

}  // namespace

TEST_CASE("a small grid is drawn voxel by voxel, a large one in cells", "[quick][grid]") {
  CHECK(CoarseView({{0, 0, 0}, {4, 1, 1}}).cell_voxels() == 1);
  CHECK(CoarseView({{0, 0, 0}, {5, 1, 1}}).cell_voxels() == 2);
  CHECK(CoarseView({{-8, 0, 0}, {8, 9, 1}}).cell_voxels() == 4);
  CHECK(CoarseView({{-33554432, 0, 0}, {33554431, 1, 1}}).cell_voxels() == 1 << 24);
  CHECK(CoarseView({}).empty(Layer::solid));
  CHECK(CoarseView({}).surface(Layer::closing, {}).empty());
}

TEST_CASE("the surface of cells encloses them", "[quick][grid]") {
  const int bricks = GENERATE(1, 7, 63, 1023);  // cells of 1, 2, 16 and 256 voxels
  CAPTURE(bricks);
  CoarseView view({{-2, -2, -2}, {bricks - 1, 1, 1}});
  const double side = view.cell_voxels();
  CHECK(side == (bricks == 1 ? 1 : (bricks + 1) / 4));
  Brick b = brick_at({-1, -1, -1});
  b.bits[5 * 64 + 7] = std::uint64_t(1) << 40;
  view.add(b);
  GridFrame frame;
  frame.voxel = 0.5;
  frame.origin = {100, -50, 7};
  TriangleTotals totals;
  const std::vector<TriangleD> one = view.surface(Layer::solid, frame);
  CHECK(one.size() == 12);
  totals.add(one);
  CHECK(std::abs(*totals.volume / (side * side * side / 8) - 1) < 1e-9);
  CHECK(totals.area == 6 * side * side / 4);
  const double x = (100 + std::floor((-64 + 40) / side) * side) / 2;
  CHECK(totals.bounds.min[0] == x);
  CHECK(totals.bounds.max[0] == x + side / 2);
  CHECK(view.empty(Layer::closing));
}

TEST_CASE("faces in a row are one rectangle, across bricks too", "[quick][grid]") {
  CoarseView view({{0, 0, 0}, {2, 1, 1}});
  for (int x = 0; x < 2; ++x) {
    Brick b = brick_at({x, 0, 0});
    b.fill = BrickFill::full;
    b.layer = Layer::closing;
    b.bits.fill(~std::uint64_t(0));
    view.add(b);
  }
  const std::vector<TriangleD> faces = view.surface(Layer::closing, {});
  TriangleTotals totals;
  totals.add(faces);
  CHECK(std::abs(*totals.volume / (2.0 * 64 * 64 * 64) - 1) < 1e-9);
  CHECK(totals.area == 2.0 * 64 * 64 * 5);
  CHECK(faces.size() == 2 * 2 * (64 + 64 + 64));
}
