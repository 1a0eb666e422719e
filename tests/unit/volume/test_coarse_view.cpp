#include <cmath>

#include "lib/volume/coarse_view.h"
#include "tests/catch.h"

using namespace bp;

TEST_CASE("a small grid is drawn voxel by voxel, a large one in cells", "[quick][grid]") {
  CHECK(CoarseView({{0, 0, 0}, {4, 1, 1}}).cell_voxels() == 1);
  CHECK(CoarseView({{0, 0, 0}, {5, 1, 1}}).cell_voxels() == 2);
  CHECK(CoarseView({{-8, 0, 0}, {8, 9, 1}}).cell_voxels() == 4);
  CHECK(CoarseView({{-33554432, 0, 0}, {33554431, 1, 1}}).cell_voxels() == 1 << 24);
  CHECK(CoarseView({}).cells(Layer::solid).box().empty());
}

TEST_CASE("a voxel occupies the cell that holds it", "[quick][grid]") {
  const int bricks = GENERATE(1, 7, 63, 1023);  // cells of 1, 2, 16 and 256 voxels
  CAPTURE(bricks);
  CoarseView view({{-2, -2, -2}, {bricks - 1, 1, 1}});
  const int side = view.cell_voxels();
  CHECK(side == (bricks == 1 ? 1 : (bricks + 1) / 4));
  Brick b;
  b.coord = {-1, -1, -1};
  b.fill = BrickFill::mixed;
  b.bits[5 * 64 + 7] = std::uint64_t(1) << 40;
  view.add(b);
  CHECK(view.cells(Layer::solid).count() == 1);
  CHECK(view.cells(Layer::solid).test({floor_div(40 - 64, side), floor_div(7 - 64, side), floor_div(5 - 64, side)}));
  CHECK(view.cells(Layer::closing).count() == 0);
  GridFrame frame;
  frame.voxel = 0.5;
  frame.origin = {100, -50, 7};
  const double x = (100 + std::floor((-64 + 40) / double(side)) * side) / 2;
  CHECK(view.bounds(Layer::solid, frame).min[0] == x);
  CHECK(view.bounds(Layer::solid, frame).max[0] == x + side / 2.0);
  CHECK(view.bounds(Layer::closing, frame).empty());
}
