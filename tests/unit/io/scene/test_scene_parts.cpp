#include "io/files/name_pattern.h"
#include "io/scene/part_names.h"
#include "tests/catch.h"
#include "tests/unit/io/scene/gltf_document.h"

using namespace bp;
using namespace bp::test;

namespace {

/// Least x of each triangle of the parts that fit.
std::vector<double> parts_of(const std::string& path, const std::string& pattern) {
  SceneOptions options;
  options.parts = pattern;
  std::vector<double> at;
  const auto source = open_scene(path, options);
  for (int pass = 0; pass < 2; ++pass) {  // the same after a rewind
    at.clear();
    source->rewind();
    for (const TriangleD& t : read_all(*source)) at.push_back(std::min({t[0][0], t[1][0], t[2][0]}));
  }
  return at;
}

}  // namespace

TEST_CASE("* stands for any characters of a name, ? for one", "[quick][io]") {
  CHECK(fits_pattern("pipe_12", "pipe_*"));
  CHECK(fits_pattern("pipe_", "pipe_*"));
  CHECK_FALSE(fits_pattern("a pipe_1", "pipe_*"));
  CHECK(fits_pattern("a pipe_1", "*pipe_?"));
  CHECK(fits_pattern("abcabcd", "*abcd"));
  CHECK(fits_pattern("x", "**"));
  CHECK(fits_pattern("", "*"));
  CHECK(fits_pattern("*", "*"));
  CHECK_FALSE(fits_pattern("", "?"));
  CHECK_FALSE(fits_pattern("ab", "a"));
  CHECK_FALSE(fits_pattern(std::string(2000, 'a'), "*a*a*a*a*a*a*a*a*b"));
}

TEST_CASE("parts of OBJ are named by objects, groups and materials", "[quick][io]") {
  const TempDir dir;
  const std::string file = dir.file("a.obj",
                                    "v 0 0 0\nv 0 1 0\nv 0 0 1\nv 5 0 0\nv 5 1 0\nv 5 0 1\nv 7 0 0\nv 7 1 0\nv 7 0 1\n"
                                    "f 1 2 3\no head\nf 1 2 3\ng left arm\nusemtl steel\nf 4 5 6\no foot\nf 7 8 9\n"
                                    "g\nusemtl a wood\nf 1 2 3\n");
  CHECK(parts_of(file, "head") == std::vector<double>{0, 5});
  CHECK(parts_of(file, "arm") == std::vector<double>{5, 7});
  CHECK(parts_of(file, "left arm") == std::vector<double>{5, 7});
  CHECK(parts_of(file, "steel") == std::vector<double>{5, 7});
  CHECK(parts_of(file, "*wood") == std::vector<double>{0});
  CHECK(parts_of(file, "f*").size() == 2);
  CHECK(parts_of(file, "nothing").empty());
  CHECK(parts_of(file, "*").size() == 4);
}

TEST_CASE("parts of glTF are named by nodes with all below them, meshes and materials", "[quick][io]") {
  Document d;
  const auto quad = d.quad_mesh();
  d.json["meshes"][quad]["name"] = "quad";
  d.json["meshes"].push_back(d.json["meshes"][quad]);
  d.json["meshes"][1]["name"] = "other";
  d.json["meshes"][1]["primitives"][0]["material"] = 0;
  d.json["materials"] = {{{"name", "red"}}};
  d.json["nodes"] = {{{"name", "root"}, {"children", {1, 2, 3}}},
                     {{"name", "arm_left"}, {"mesh", 0}, {"translation", {10, 0, 0}}, {"children", {4}}},
                     {{"mesh", 1}, {"translation", {20, 0, 0}}},
                     {{"name", "arm"}, {"mesh", 0}, {"translation", {30, 0, 0}}},
                     {{"name", "hand"}, {"mesh", 1}, {"translation", {5, 0, 0}}}};
  d.json["scenes"] = {{{"nodes", {0}}}};
  const TempDir dir;
  const std::string file = dir.file("a.glb", d.glb());
  CHECK(parts_of(file, "arm_*") == std::vector<double>{10, 10, 15, 15});
  CHECK(parts_of(file, "root").size() == 8);
  CHECK(parts_of(file, "quad") == std::vector<double>{10, 10, 30, 30});
  CHECK(parts_of(file, "red") == std::vector<double>{15, 15, 20, 20});
  CHECK(parts_of(file, "none").empty());
}

TEST_CASE("formats without names are refused where parts are asked for", "[quick][io]") {
  const TempDir dir;
  SceneOptions options;
  options.parts = "x";
  const std::string file = dir.file("a.off", "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  CHECK_THROWS_AS(open_scene(file, options), Error);
}

TEST_CASE("parts are asked for by a triangle, and have one name each", "[quick][io]") {
  const TempDir dir;
  const auto names_at = [&](const std::string& path, double x) {
    SceneOptions options;
    options.part_names = std::make_shared<PartNames>();
    options.part_names->of_triangle = [&](const std::string&, const TriangleD& t) {
      return std::min({t[0][0], t[1][0], t[2][0]}) == x;
    };
    const std::size_t all = read_all(path, options).size();
    CHECK(all == read_all(path).size());  // none is left out
    return options.part_names->names;
  };
  const std::string obj = dir.file("a.obj",
                                   "v 0 0 0\nv 0 1 0\nv 0 0 1\nv 5 0 0\nv 5 1 0\nv 5 0 1\nv 7 0 0\nv 7 1 0\nv 7 0 1\n"
                                   "mtllib of_none.mtl\nusemtl steel\nf 1 2 3\no head\nf 4 5 6\ng left arm\nf 5 7 8 4\n"
                                   "o foot\nf 7 8 9\n");
  using Names = std::set<std::string>;
  CHECK(names_at(obj, 0) == Names{"steel"});
  CHECK(names_at(obj, 5) == Names{"head", "left arm"});
  CHECK(names_at(obj, 7) == Names{"foot"});
  CHECK(names_at(obj, 9) == Names{});
  Document d;
  const auto quad = d.quad_mesh();
  d.json["meshes"][quad]["name"] = "quad";
  d.json["nodes"] = {{{"name", "root"}, {"children", {1, 2, 3}}},
                     {{"name", "arm"}, {"mesh", quad}, {"translation", {10, 0, 0}}},
                     {{"mesh", quad}, {"translation", {20, 0, 0}}},
                     {{"mesh", d.quad_mesh()}, {"translation", {30, 0, 0}}}};
  d.json["scenes"] = {{{"nodes", {0}}}};
  const std::string glb = dir.file("a.glb", d.glb());
  CHECK(names_at(glb, 10) == Names{"arm"});
  CHECK(names_at(glb, 20) == Names{"quad"});
  CHECK(names_at(glb, 30) == Names{"nodes[3]"});
}
