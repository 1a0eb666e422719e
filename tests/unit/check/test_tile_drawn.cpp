#include "lib/check/tile_cover.h"
#include "lib/check/tile_drawn.h"
#include "tests/catch.h"
#include "tests/support/memory_scene.h"

namespace bp::test {

namespace {

CoverTile tile(const std::string& place, const std::string& uri, std::vector<std::size_t> children, double error) {
  CoverTile t;
  t.place = place;
  t.uri = uri;
  t.children = std::move(children);
  t.error = error;
  return t;
}

/// Three levels, each with content.
std::vector<CoverTile> drawn_tiles() {
  return {tile("root", "r", {1}, 4), tile("a", "a", {2, 3}, 2), tile("b", "b", {}, 0), tile("c", "c", {}, 0)};
}

const Bounds3d kDrawnScene{{0, 0, 0}, {3, 4, 12}};  // a diagonal of 13

/// Returns the tile of each finding; "?" before undecided ones.
std::string undrawn(const std::vector<CoverTile>& tiles, double error = 13) {
  std::string all;
  for (const TileFinding& f : check_drawn(tiles, error, kDrawnScene))
    all += (f.answer == Answer::undecided ? "?" : "") + f.text.substr(0, f.text.find(':')) + " ";
  return all;
}

}  // namespace

TEST_CASE("a viewer that tolerates an error as large as the scene may draw nothing", "[quick][check][tileset]") {
  CHECK(undrawn(drawn_tiles()).empty());
  CHECK(undrawn(drawn_tiles(), 12.9) == "?tileset ");
  CHECK(undrawn(drawn_tiles(), 11.9) == "tileset ");
  std::vector<CoverTile> tiles = drawn_tiles();
  tiles[0].uri.clear();
  CHECK(undrawn(tiles) == "root ");
  tiles[0].error = 12.5;
  CHECK(undrawn(tiles) == "?root ");
  tiles[0].error = 13;
  CHECK(undrawn(tiles).empty());
  tiles[1].uri.clear();
  CHECK(undrawn(tiles) == "a ");
  tiles[1].is_joint = true;  // no viewer meets it
  CHECK(undrawn(tiles).empty());
}

TEST_CASE("a tile without content must have the error of what the scene has in its cell", "[quick][check][tileset]") {
  std::vector<CoverTile> tiles = drawn_tiles();
  tiles[1].uri.clear();
  tiles[1].cell = Bounds3d{{0, 0, 10.5}, {8, 8, 16}};  // 3 x 4 x 1.5 of the scene
  tiles[1].error = 3.9;
  CHECK(undrawn(tiles) == "a ");
  tiles[1].error = 5;
  CHECK(undrawn(tiles) == "?a ");
  tiles[1].error = 5.3;
  CHECK(undrawn(tiles).empty());
  tiles[1].cell = Bounds3d{{8, 8, 8}, {16, 16, 16}};  // none
  tiles[1].error = 0;
  CHECK(undrawn(tiles).empty());
}

TEST_CASE("where no tile has a cell, what is replaced has a content below", "[quick][check][tileset]") {
  std::vector<CoverTile> tiles = drawn_tiles();
  tiles[2].uri.clear();
  CHECK(undrawn(tiles).empty());
  tiles[3].uri.clear();
  CHECK(undrawn(tiles) == "root a ");
  tiles[1].adds = true;  // stays
  CHECK(undrawn(tiles).empty());
  CHECK(tiles_held_above(tiles) == std::vector<bool>{false, false, true, true});
  tiles[1].adds = false;
  tiles[0].adds = true;
  CHECK(undrawn(tiles).empty());
  CHECK(tiles_held_above(tiles) == std::vector<bool>{false, true, true, true});
  tiles[0].adds = false;
  tiles[3].cell = Bounds3d{{0, 0, 0}, {1, 1, 1}};  // which is for check_cover() to tell
  CHECK(undrawn(tiles).empty());
}

TEST_CASE("below a tile that is added to, tiles may be missing and draw nothing", "[quick][check][tileset]") {
  Triangles box, shell;
  add_box(box, {2, 2, 2}, {14, 3, 3});
  add_box(shell, {1, 1, 1}, {15, 4, 4});
  IndexedMesh mesh;
  for (const TriangleD& t : shell) {
    const auto n = std::uint32_t(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), t.begin(), t.end());
    mesh.triangles.push_back({n, n + 1, n + 2});
  }
  MemorySource scene(box, 5);
  const auto found = [&](bool adds, std::vector<std::size_t> children) {
    std::vector<CoverTile> tiles{tile("root", "r", std::move(children), 1), tile("a", "a", {}, 0),
                                 tile("b", "", {}, 0)};
    tiles[0].cell = Bounds3d{{0, 0, 0}, {16, 16, 16}};
    tiles[1].cell = Bounds3d{{0, 0, 0}, {8, 8, 8}};
    tiles[2].cell = Bounds3d{{8, 0, 0}, {16, 8, 8}};
    tiles[0].triangles = tiles[1].triangles = 12;
    tiles[0].adds = adds;
    return check_cover(
               tiles, [&](std::size_t) { return mesh; }, scene)
        .findings.size();
  };
  CHECK(found(false, {1, 2}) == 1);
  CHECK(found(true, {1, 2}) == 0);
  CHECK(found(false, {1}) == 1);
  CHECK(found(true, {1}) == 0);
}

}  // namespace bp::test
