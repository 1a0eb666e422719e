#include <fmt/format.h>

#include "lib/tileset/tile_tree.h"
#include "tests/catch.h"

namespace bp::test {

namespace {

constexpr double kWhole = 8;  // error of the level in one mesh

/// The cell of a tile as its content, in scene units.
TreeTile tile(const GridFrame& frame, CellCoord cell) {
  const Cells cells{64};
  TreeTile out;
  out.uri = fmt::format("{}{}{}", cell.x, cell.y, cell.z);
  out.bounds = cell_bounds(cells, frame, cell);
  out.origin = out.bounds.min;
  out.error_world = 1;
  return out;
}

/// A level of tiles at opposite corners of four cells a side; above it a level in one mesh, or nothing.
Tileset far_corners(bool whole) {
  const GridFrame frame{0.375, {-8, 4, 1000}, UpAxis::z};
  TileTree tree(UpAxis::z, Cells{64});
  for (const CellCoord cell : {CellCoord{0, 0, 0}, CellCoord{1, 0, 0}, CellCoord{3, 3, 3}})
    tree.add(0, frame, cell, tile(frame, cell));
  TreeTile one;
  one.uri = "whole";
  one.error_world = kWhole;
  if (whole) tree.add_whole(one);
  return tree.finish(1000);
}

std::string uris_below(const Tile& tile) {
  std::string all;
  for (const Tile& child : tile.children) all += child.uri + " ";
  return all;
}

}  // namespace

TEST_CASE("below a content every tile draws something", "[quick][tileset]") {
  const Tileset tileset = far_corners(true);
  CHECK(tileset.root.uri == "whole");
  CHECK(tileset.root.geometric_error == kWhole);
  CHECK(tileset.root.children.size() == 3);
  CHECK_THAT(uris_below(tileset.root),
             ContainsSubstring("000") && ContainsSubstring("100") && ContainsSubstring("333"));
}

TEST_CASE("on top of all contents the error is that of drawing nothing", "[quick][tileset]") {
  const Tileset tileset = far_corners(false);
  CHECK(tileset.root.uri.empty());
  CHECK(tileset.root.geometric_error == 1000);
  REQUIRE(tileset.root.children.size() == 2);
  for (const Tile& child : tileset.root.children) {
    CHECK(child.uri.empty());
    CHECK(child.geometric_error == 1000);
    CHECK(child.children.front().geometric_error == 1);
  }
}

TEST_CASE("tiles stand where their origins are, however many stand between", "[quick][tileset]") {
  for (const bool whole : {true, false}) {
    int met = 0;
    for_each_tile(far_corners(whole), [&](const Tile& tile, const std::string&, const Transform& m) {
      if (tile.uri != "333") return;
      ++met;
      CHECK(transformed(m, {0, 0, 0}) == Vec3d{(3 * 64 - 8) * 0.375, (3 * 64 + 4) * 0.375, (3 * 64 + 1000) * 0.375});
    });
    CHECK(met == 1);
  }
}

}  // namespace bp::test
