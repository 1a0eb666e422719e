#include <cmath>
#include <nlohmann/json.hpp>

#include "io/tiles/tileset_file.h"
#include "tests/catch.h"
#include "tests/unit/io/scene/scene_files.h"

using namespace bp;
using namespace bp::test;

namespace {

std::string complaint(const TempDir& dir, const std::string& json) {
  try {
    (void)read_tileset(dir.file("tileset.json", json));
  } catch (const Error& e) {
    return e.code() == ErrorCode::bad_input ? e.what() : "wrong code";
  }
  return "";
}

const std::string kBox = R"("boundingVolume": {"box": [0,0,0, 1,0,0, 0,1,0, 0,0,1]})";

std::string tileset(const std::string& root) {
  return R"({"asset": {"version": "1.1"}, "geometricError": 3, "root": {)" + root + "}}";
}

}  // namespace

TEST_CASE("a tileset that is written is read back the same", "[quick][io][lod]") {
  Tileset t;
  t.up = UpAxis(GENERATE(range(0, 6)));
  t.geometric_error = 1.0 / 3;
  t.root.volume.box = TileBox{{0.1, 0.2, 0.3}, {Vec3d{1, 2, 3}, Vec3d{4, 5, 6}, Vec3d{7, 8, 9}}};
  t.root.transform[12] = 4.9e5 + 1.0 / 7;
  t.root.geometric_error = 0.3;
  t.root.refine = "REPLACE";
  t.root.children.resize(2);
  t.root.children[0].volume.box = TileBox{};
  t.root.children[1].volume.box = TileBox{};
  t.root.children[1].uri = "a.glb";
  const TempDir dir;
  t.root.children[1].cell = Bounds3d{{-1.0 / 3, 2, 3}, {4, 5, 1e6 + 1.0 / 7}};
  const Tileset back = read_tileset(dir.file("tileset.json", tileset_text(t, {{"bplod", "0.1.0", "level=0", "00ff"}})));
  CHECK(back.version == "1.1");
  CHECK(back.up == t.up);
  CHECK(back.geometric_error == t.geometric_error);
  CHECK(back.root.volume.box->centre == t.root.volume.box->centre);
  CHECK(back.root.volume.box->axes == t.root.volume.box->axes);
  CHECK(back.root.transform == t.root.transform);
  CHECK(back.root.refine == "REPLACE");
  CHECK(back.root.uri.empty());
  REQUIRE(back.root.children.size() == 2);
  CHECK(back.root.children[1].uri == "a.glb");
  CHECK(back.root.children[1].cell == t.root.children[1].cell);
  CHECK(!back.root.cell);
  CHECK(back.root.children[0].children.empty());
}

TEST_CASE("a placement moves the root of the file alone", "[quick][io][lod][place]") {
  Tileset t;
  t.root.volume.box = TileBox{{0, 0, 0}, {Vec3d{100, 0, 0}, Vec3d{0, 50, 0}, Vec3d{0, 0, 10}}};
  t.root.transform[12] = 84900 + 1.0 / 7, t.root.transform[14] = 5;
  t.root.refine = "REPLACE";
  t.root.uri = "a.glb";
  Placement& placement = t.placement.emplace();
  placement.place = {4.36, 52.01, 43};
  placement.at = {84900, 0, 0};
  placement.crs = "EPSG:28992", placement.operation = "some way", placement.scene_up = UpAxis::x;
  const TempDir dir;
  const std::string text = tileset_text(t, {});
  const Tileset back = read_tileset(dir.file("tileset.json", text));
  REQUIRE(back.placement);
  CHECK(back.root.transform == t.root.transform);
  CHECK(back.placement->place.lat == 52.01);
  CHECK(back.placement->at == placement.at);
  CHECK(back.placement->crs == placement.crs);
  CHECK(back.placement->operation == placement.operation);
  CHECK(back.placement->scene_up == placement.scene_up);
  CHECK(back.placement->off == 0);

  auto json = nlohmann::json::parse(text);
  const Vec3d ecef = transformed(json["root"]["transform"].get<Transform>(), {0, 0, 0});
  CHECK(std::abs(globe_place(ecef).height - 48) < 1e-3);
  const auto off = [&] { return read_tileset(dir.file("tileset.json", json.dump())).placement->off; };
  json["root"]["transform"][13] = json["root"]["transform"][13].get<double>() + 0.5;
  CHECK(off() == Approx(0.5));
  json["root"]["transform"][13] = json["root"]["transform"][13].get<double>() - 0.5;
  json["root"]["transform"][0] = json["root"]["transform"][0].get<double>() + 0.001;  // 100 m away
  CHECK(off() == Approx(0.1));
  json["root"].erase("transform");
  CHECK(off() > 6e6);
  json["asset"]["extras"]["placement"] = "on my desk";  // somebody else's
  CHECK_FALSE(read_tileset(dir.file("tileset.json", json.dump())).placement);
}

TEST_CASE("names of contents are written percent-encoded and read decoded", "[quick][io][lod]") {
  Tileset t;
  t.root.volume.box = TileBox{};
  t.root.refine = "REPLACE";
  t.root.uri = "a#b?c%20d \xc3\xbc/0_-1_2.glb";
  const std::string text = tileset_text(t, {});
  CHECK_THAT(text, Contains("\"a%23b%3Fc%2520d%20%C3%BC/0_-1_2.glb\""));
  const TempDir dir;
  CHECK(read_tileset(dir.file("tileset.json", text)).root.uri == t.root.uri);
  const auto read_back = [&](const std::string& uri) {
    return read_tileset(
               dir.file("tileset.json", tileset(kBox + R"(, "geometricError": 3, "content": {"uri": ")" + uri + "\"}")))
        .root.uri;
  };
  CHECK(read_back("%c3%BC/a%2Eglb?v=2") == "\xc3\xbc/a.glb");
  CHECK_THROWS_AS(read_back("50%.glb"), Error);
  CHECK_THROWS_AS(read_back("%c3%BC%2fa.glb"), Error);
}

TEST_CASE("a tileset may be large", "[quick][io][lod]") {
  const TempDir dir;
  const std::string text = tileset(kBox + R"(, "geometricError": 3)");
  CHECK(complaint(dir, text + std::string(std::size_t(65) << 20, ' ')).empty());
}

TEST_CASE("a tileset keeps to the memory for documents, its tiles included", "[quick][io][lod]") {
  const TempDir dir;
  std::string tiles = kBox + R"(, "geometricError": 3, "children": [)";
  for (int i = 0; i < 100; ++i) tiles += std::string(i > 0 ? "," : "") + "{" + kBox + R"(, "geometricError": 3})";
  const std::string path = dir.file("tileset.json", tileset(tiles + "]"));
  SceneOptions options;
  options.document.bytes = 101 * kTileBytes;
  CHECK_THROWS_AS(read_tileset(path, options), NeedsMemory);
  options.document.bytes *= 4;
  CHECK(read_tileset(path, options).root.children.size() == 100);
}

TEST_CASE("what may move, hide or cull and is not read is noted once, with its first place", "[quick][io][lod]") {
  const TempDir dir;
  const auto unread = [&](const std::string& root) {
    const Tileset t = read_tileset(dir.file("tileset.json", tileset(root)));
    return t.not_understood;
  };
  const std::string error = R"(, "geometricError": 3)", odd = R"("wobble": 1, )" + kBox + error;
  CHECK(unread(kBox + error + R"(, "extras": {"a": 1}, "content": {"uri": "a.glb", "group": 0})").empty());
  const std::vector<std::string> twice = unread(odd + R"(, "children": [{)" + odd + "}]");
  REQUIRE(twice.size() == 1);
  CHECK_THAT(twice[0], Contains("root and 1 more: wobble"));
  CHECK_THAT(unread(R"("boundingVolume": {"region": [0, 0, 1, 1, 0, 1]})" + error)[0],
             Contains("root.boundingVolume: region"));
  CHECK_THAT(unread(kBox + error + R"(, "content": {"uri": "a.glb", "expire": 1})")[0],
             Contains("root.content: expire"));
}

TEST_CASE("volumes of tiles and contents are boxes, spheres, or both", "[quick][io][lod]") {
  const TempDir dir;
  const std::string ball = R"("boundingVolume": {"sphere": [1, 2, 3, 4]})";
  const std::string both = R"("boundingVolume": {"sphere": [1, 2, 3, 4], "box": [0,0,0, 1,0,0, 0,1,0, 0,0,1]})";
  const Tileset t = read_tileset(
      dir.file("tileset.json", tileset(both + R"(, "geometricError": 3, "content": {"uri": "a.glb", )" + ball + "}")));
  CHECK(t.root.volume.box);
  CHECK(t.root.volume.sphere->radius == 4);
  REQUIRE(t.root.content_volume);
  CHECK(!t.root.content_volume->box);
  CHECK(t.root.content_volume->sphere->centre == Vec3d{1, 2, 3});
}

TEST_CASE("a broken tileset is refused with the place", "[quick][io][lod]") {
  const TempDir dir;
  CHECK_THAT(complaint(dir, "{"), Contains("broken JSON"));
  CHECK_THAT(complaint(dir, "[]"), Contains("not an object"));
  CHECK_THAT(complaint(dir, R"({"asset": {"version": "1.1"}, "geometricError": 3})"), Contains("root"));
  CHECK_THAT(complaint(dir, tileset(R"("geometricError": 3)")), Contains("boundingVolume"));
  CHECK_THAT(complaint(dir, tileset(R"("geometricError": 3, "boundingVolume": {})")), Contains("neither a box"));
  CHECK_THAT(complaint(dir, tileset(R"("geometricError": 3, "boundingVolume": {"box": [1]})")), Contains("12"));
  CHECK_THAT(complaint(dir, tileset(kBox)), Contains("geometricError"));
  CHECK_THAT(complaint(dir, tileset(kBox + R"(, "geometricError": 3, "children": [])")), Contains("children"));
  CHECK_THAT(complaint(dir, tileset(kBox + R"(, "geometricError": 3, "children": [7])")), Contains("root.children[0]"));
  CHECK_THAT(complaint(dir, tileset(kBox + R"(, "geometricError": 3, "implicitTiling": {})")), Contains("implicit"));
  for (const char* const name : {"implicit_tiling", "multiple_contents"}) {
    const std::string extension =
        std::string(R"(, "geometricError": 3, "extensions": {"3DTILES_)") + name + R"(": {}})";
    CHECK_THAT(complaint(dir, tileset(kBox + extension)), Contains("not read"));
  }
  CHECK_THAT(complaint(dir, tileset(kBox + R"(, "geometricError": 3, "contents": [])")), Contains("several contents"));
  CHECK_THAT(
      complaint(dir, R"({"asset": {"version": "1.1"}, "geometricError": 3, "extensionsRequired": ["3DTILES_foo"]})"),
      Contains("requires \"3DTILES_foo\""));
  CHECK_THAT(complaint(dir, tileset(kBox + R"(, "geometricError": 3, "content": {"uri": "a.json"})")),
             Contains("tileset of its own"));
  std::string deep = kBox + R"(, "geometricError": 0)";
  for (int i = 0; i < 70; ++i) deep = kBox + R"(, "geometricError": 0, "children": [{)" + deep + "}]";
  CHECK_THAT(complaint(dir, tileset(deep)), Contains("below 64"));
  CHECK(complaint(dir, tileset(kBox + R"(, "geometricError": 3)")).empty());
}

TEST_CASE("a tileset may be of version 1.0, and have volumes that are not looked at", "[quick][io][lod]") {
  const TempDir dir;
  const std::string s2 = R"("boundingVolume": {"extensions": {"3DTILES_bounding_volume_S2": {}}}, "geometricError": 3)";
  const std::string root = tileset(s2 + R"(, "content": {"url": "a%20b.b3dm"})");
  const Tileset t =
      read_tileset(dir.file("t.json", R"({"extensionsRequired": ["3DTILES_bounding_volume_S2"], )" + root.substr(1)));
  CHECK(!t.root.volume.box);
  CHECK(t.root.uri == "a b.b3dm");
}
