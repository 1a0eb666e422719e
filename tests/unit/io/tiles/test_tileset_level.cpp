#include "io/tiles/tileset_level.h"
#include "tests/unit/io/scene/gltf_document.h"

using namespace bp;
using namespace bp::test;

namespace {

Tile node(const std::string& uri, std::vector<Tile> children = {}, double x = 0) {
  Tile t;
  t.uri = uri;
  t.transform[12] = x;
  t.children = std::move(children);
  return t;
}

/// A root without content above two branches, of which one is shorter; in the longer one a tile without content.
Tileset example() {
  Tileset t;
  t.root = node("", {node("a", {node("", {node("c"), node("d", {node("e", {}, 100)}, 10)}, 1)}), node("b")}, 1000);
  t.root.refine = "REPLACE";
  return t;
}

/// Names of the files beside a tileset, and their offsets along x.
std::string met(const TempDir& dir, const Tileset& tileset, std::size_t level) {
  std::string all;
  for (const PlacedContent& c : tileset_level(tileset, dir.path("tileset.json"), level).contents)
    all += fmt::format("{} {}, ", std::filesystem::path(c.path).filename().string(), c.transform[12]);
  return all;
}

}  // namespace

TEST_CASE("a level of a tileset is as far above its deepest tile, or what stands for it", "[quick][io][lod]") {
  const TempDir dir;
  for (const char* name : {"a", "b", "c", "d", "e"}) (void)dir.file(name, "");
  Tileset t = example();
  CHECK(tileset_level(t, dir.path("tileset.json"), 0).levels == 3);  // at one depth there are none
  CHECK(met(dir, t, 0) == "c 1001, e 1111, b 1000, ");
  CHECK(met(dir, t, 1) == "c 1001, d 1011, b 1000, ");
  CHECK(met(dir, t, 2) == "a 1000, b 1000, ");
  CHECK(met(dir, t, 3).empty());
  t.root.refine = "ADD";
  CHECK(met(dir, t, 1) == "a 1000, c 1001, d 1011, b 1000, ");
  t.root.refine = "add";  // as version 1.0 allows
  CHECK(met(dir, t, 1) == "a 1000, c 1001, d 1011, b 1000, ");
  t.root.children[0].children[0].refine = "REPLACE";
  CHECK(met(dir, t, 0) == "a 1000, c 1001, e 1111, b 1000, ");
  CHECK(tileset_level(Tileset{}, "tileset.json", 0).levels == 0);
}

TEST_CASE("leaves are no level, nor is what leads to them", "[quick][io][lod]") {
  const TempDir dir;
  for (const char* name : {"a", "b", "leaf"}) (void)dir.file(name, "");
  Tile leaf = node("leaf");
  leaf.is_leaf = true;
  Tileset t;
  t.root = node("a", {node("b", {node("", {leaf, leaf}), leaf}), leaf});
  CHECK(tileset_level(t, dir.path("tileset.json"), 0).levels == 2);
  CHECK(met(dir, t, 0) == "b 0, ");
  CHECK(met(dir, t, 1) == "a 0, ");
}

TEST_CASE("contents that are not there are named", "[quick][io][lod]") {
  const TempDir dir;
  for (const char* name : {"b", "c"}) (void)dir.file(name, "");
  const TilesetLevel level = tileset_level(example(), dir.path("tileset.json"), 0);
  CHECK(level.contents.size() == 2);
  CHECK(level.missing == std::vector<std::string>{"e"});
}

TEST_CASE("contents of a tileset stand in the axes of its scene", "[quick][io][lod]") {
  const TempDir dir;
  Document d;
  const int colors_of = d.floats({{1, 0, 0}, {1, 0, 0}, {1, 0, 0}});
  d.node({{"mesh", d.mesh(d.floats({{0, 0, 0}, {1, 0, 0}, {0, 2, 0}}))}});
  d.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = colors_of;
  (void)dir.file("a.glb", d.glb());
  Tileset t;
  t.root = node("a.glb");
  t.root.transform[12] = 100, t.root.transform[14] = 50;  // 50 up
  t.up = UpAxis(GENERATE(range(0, 6)));
  SceneOptions options;
  options.colors = true;
  const auto source = open_contents(t, tileset_level(t, dir.path("tileset.json"), 0).contents, "tileset.json", options);
  TriangleD upright{Vec3d{100, 50, 0}, Vec3d{101, 50, 0}, Vec3d{100, 52, 0}};  // y up
  for (Vec3d& p : upright) p = to_y_up(t.up).inverse()(p);
  std::vector<TriangleD> triangles;
  std::vector<TriangleColors> colors;
  for (int pass = 0; pass < 2; ++pass) {
    REQUIRE(source->read_colored(triangles, colors));
    CHECK(triangles == std::vector<TriangleD>{upright});
    CHECK(colors.size() == 1);
    CHECK_FALSE(source->read_colored(triangles, colors));
    CHECK(triangles.empty());
    CHECK(source->has_colors());
    CHECK(source->counts().triangles == 1);
    source->rewind();
  }
  CHECK(source->up() == t.up);
}
