#include <sys/stat.h>

#include "io/tiles/tile_content.h"
#include "lib/core/error.h"
#include "lib/place/globe.h"
#include "tests/catch.h"
#include "tests/unit/io/scene/gltf_document.h"

using namespace bp;
using namespace bp::test;

namespace {

constexpr const char* kEnd = "/tileset.json";

/// A triangle in the corner of the axes of glTF.
std::string content(const Json& extensions = nullptr) {
  Document d;
  d.node({{"mesh", d.mesh(d.floats({{0, 0, 0}, {1, 0, 0}, {0, 2, 0}}))}});
  if (!extensions.is_null()) d.json["extensions"] = extensions;
  return d.glb();
}

Json at(double x, double y = 0, double z = 0) {
  return {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, z, 1};
}

/// A tile without volumes: a scene does not ask for them.
Json tile(const std::string& uri, double x = 0, const Json& children = Json::array()) {
  Json t{{"transform", at(x)}, {"geometricError", 1}};
  if (!uri.empty()) t["content"]["uri"] = uri;
  if (!children.empty()) t["children"] = children;
  return t;
}

/// The asset of a tileset that this suite made.
const Json kOurs{{"version", "1.1"}, {"extras", {{"provenance", Json::array()}}}};

std::string tileset(const Json& root, const Json& asset = {{"version", "1.1"}}) {
  return Json{{"asset", asset}, {"geometricError", 9}, {"root", root}}.dump();
}

/// Tiles as they are met: where the corner of each stands along x.
std::string drawn(const std::string& path) {
  std::string all;
  for (const TriangleD& t : read_all(path)) all += fmt::format("{} ", t[0][0]);
  return all;
}

/// The triangle of content(), moved, where y or z is up.
TriangleD upright(const Vec3d& p) {
  return {{p, {p[0] + 1, p[1], p[2]}, {p[0], p[1], p[2] + 2}}};
}

std::string b3dm(const std::string& features, const std::string& binary = "") {
  const std::string glb = content();
  const auto size = std::uint32_t(28 + features.size() + binary.size() + glb.size());
  return "b3dm" + raw(1U) + raw(size) + raw(std::uint32_t(features.size())) + raw(std::uint32_t(binary.size())) +
         raw(0U) + raw(0U) + features + binary + glb;
}

}  // namespace

TEST_CASE("a tileset is a scene of its leaves, and of all tiles that are added to", "[quick][io]") {
  const TempDir dir;
  for (const char* name : {"a.glb", "b.glb", "c d.glb"}) (void)dir.file(name, content());
  Json root = tile("a.glb", 1000, {tile("b.glb", 10, {tile("c%20d.glb", 1), tile("", 2)}), tile("b.glb", 20)});
  root["refine"] = "REPLACE";
  CHECK(drawn(dir.file("t.json", tileset(root))) == "1011 1020 ");
  root["children"][0]["refine"] = "ADD";
  CHECK(drawn(dir.file("t.json", tileset(root))) == "1010 1011 1020 ");
  root["refine"] = "add";  // as version 1.0 allows
  root["children"][0]["refine"] = "REPLACE";
  CHECK(drawn(dir.file("t.json", tileset(root))) == "1000 1011 1020 ");
  root = tile("a.glb", 0, {tile("a.glb", 1), tile("b.glb", 2)});
  root["children"][1]["extras"]["leaf"] = true;  // of ours: beside it stands no scene
  CHECK(drawn(dir.file("t.json", tileset(root, kOurs))) == "2 ");
  CHECK(drawn(dir.file("t.json", tileset(root))) == "1 2 ");  // somebody else's
  root = tile("");
  root["contents"] = {{{"uri", "a.glb"}}, {{"url", "b.glb?v=1"}}};
  CHECK(drawn(dir.file("t.json", tileset(root))) == "0 0 ");
}

TEST_CASE("a tileset on the globe is a scene in its own coordinates", "[quick][io][place]") {
  const TempDir dir;
  for (const char* name : {"a.glb", "b.glb"}) (void)dir.file(name, content());
  Json root = tile("", 0, {tile("a.glb", 1), tile("b.glb", 20)});
  root["transform"] = east_north_up({4.36, 52.01, 43});
  const Json placement{{"place", {4.36, 52.01, 43}}, {"origin", {1000, 0, 0}}};
  Json asset = kOurs;
  asset["extras"]["placement"] = placement;
  const std::string placed = tileset(root, asset);
  CHECK(drawn(dir.file("t.json", placed)) == "1001 1020 ");
  // Below another tileset it stands where that has it.
  const Json outer = tile("t.json", 500);
  CHECK(drawn(dir.file("outer.json", tileset(outer))) == drawn(dir.file("plain.json", [&] {
          Json moved = root;
          moved["transform"][12] = moved["transform"][12].get<double>() + 500;
          return tileset(moved);
        }())));
}

TEST_CASE("a content with a skin stands where its joints are, in its tile", "[quick][io]") {
  Document d;
  const int mesh = d.mesh(d.floats({{0, 0, 0}, {1, 0, 0}, {0, 2, 0}}));
  Json& attributes = d.json["meshes"][0]["primitives"][0]["attributes"];
  attributes["JOINTS_0"] = d.array(std::vector<std::uint8_t>(12), kU8, "VEC4", 3);
  attributes["WEIGHTS_0"] = d.array<float>({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, kF32, "VEC4", 3);
  d.node({{"mesh", mesh}, {"skin", 0}, {"translation", {100, 0, 0}}});  // which does not count
  d.node({{"translation", {0, 3, 0}}});
  d.json["scenes"][0]["nodes"] = {0, 1};
  d.json["skins"] = Json::array({{{"joints", {1}}}});
  const TempDir dir;
  (void)dir.file("a.glb", d.glb());
  const auto triangles = read_all(dir.file("t.json", tileset(tile("a.glb", 4))));
  REQUIRE(triangles.size() == 1);
  CHECK(triangles[0] == upright({4, 0, 3}));
}

TEST_CASE("contents stand where their tiles and tables say, with z up", "[quick][io]") {
  const TempDir dir;
  (void)dir.file("a.glb", content());
  (void)dir.file("rtc.glb", content({{"CESIUM_RTC", {{"center", {5, 6, 7}}}}}));
  (void)dir.file("b.b3dm", b3dm(R"({"RTC_CENTER":[100000000.25,2,3] })"));
  (void)dir.file("c.b3dm", b3dm(R"({"RTC_CENTER":{"byteOffset":4}})", raw(0.0F) + raw(1.5F) + raw(2.0F) + raw(3.0F)));
  const auto only = [&](const Json& root, const Json& asset = {{"version", "1.1"}}) {
    const auto triangles = read_all(dir.file("t.json", tileset(root, asset)));
    REQUIRE(triangles.size() == 1);
    return triangles[0];
  };
  CHECK(only(tile("a.glb", 4)) == upright({4, 0, 0}));
  CHECK(only(tile("rtc.glb", 1)) == upright({6, 6, 7}));
  CHECK(only(tile("b.b3dm", 0.25)) == upright({100000000.5, 2, 3}));  // in double
  CHECK(only(tile("c.b3dm", 1)) == upright({2.5, 2, 3}));
  const TriangleD lying{{{1, 0, 0}, {2, 0, 0}, {1, 2, 0}}};
  CHECK(only(tile("a.glb", 1), {{"version", "1.0"}, {"gltfUpAxis", "Z"}}) == lying);
  const TriangleD x_up{{{1, 0, 0}, {1, 0, 1}, {1, 2, 0}}};  // (-z, y, x), as viewers have it
  CHECK(only(tile("a.glb", 1), {{"version", "1.0"}, {"gltfUpAxis", "X"}}) == x_up);
  (void)dir.file("inner.json", tileset(tile("a.glb", 1), {{"version", "1.0"}, {"gltfUpAxis", "Z"}}));
  CHECK(only(tile("inner.json", 1)) == upright({2, 0, 0}));  // the outermost tileset tells
  CHECK_THAT(complaint_of(dir.file("t.json", tileset(tile("a.glb"), {{"version", "1.0"}, {"gltfUpAxis", "-x"}}))),
             Contains("neither X nor Y nor Z"));
  Json far = tile("a.glb");
  far["transform"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2};
  CHECK_THAT(complaint_of(dir.file("t.json", tileset(far))), Contains("last row is not 0 0 0 1"));
  CHECK(only(tile("a.glb", 1), {{"version", "1.1"}, {"extras", {{"up", "y"}}}}) == upright({1, 0, 0}));
  Json ours = kOurs;
  ours["extras"]["up"] = "y";
  CHECK(only(tile("a.glb", 1), ours) == lying);  // the scene's axes
  CHECK(open_scene(dir.path("t.json"))->up() == UpAxis::y);
}

TEST_CASE("tilesets within tilesets are read; a ring of them and a flood of them are refused", "[quick][io]") {
  const TempDir dir;
  std::filesystem::create_directories(dir.path("sub"));
  (void)dir.file("sub/a.glb", content());
  (void)dir.file(std::string("sub") + kEnd, tileset(tile("a.glb", 1)));
  Json root = tile("sub/tileset.json", 10);
  CHECK(drawn(dir.file("t.json", tileset(root))) == "11 ");
  (void)dir.file(std::string("sub") + kEnd, tileset(tile("../t.json")));
  CHECK_THAT(complaint_of(dir.path("t.json")), Contains("is a content of itself"));
  for (int i = 0; i < 20; ++i)
    (void)dir.file(fmt::format("{}.json", i),
                   tileset(tile("", 0, {tile(fmt::format("{}.json", i + 1)), tile(fmt::format("{}.json", i + 1))})));
  CHECK_THAT(complaint_of(dir.path("0.json")), Contains("16 deep"));
  for (int i = 0; i < 14; ++i) {  // each names the next one ten times
    const Json next = tile(i == 13 ? "sub/a.glb" : fmt::format("many{}.json", i + 1));
    (void)dir.file(fmt::format("many{}.json", i), tileset(tile("", 0, Json::array_t(10, next))));
  }
  CHECK_THAT(complaint_of(dir.path("many0.json")),
             Contains("stands for 100000000000000 contents in 11111111111111 til"));
  CHECK(read_all(dir.path("many11.json")).size() == 1000);
  root = tile("sub/a.glb");
  for (int i = 0; i < 70; ++i) root = tile("", 0, Json::array({root}));
  CHECK_THAT(complaint_of(dir.file("t.json", tileset(root))), Contains("lies below 64 tiles"));
  Json leaf = tile("sub/a.glb");
  leaf["extras"]["leaf"] = true;
  CHECK_THAT(complaint_of(dir.file("t.json", tileset(tile("", 0, {leaf, root})))), Contains("lies below 64 tiles"));
}

TEST_CASE("tilesets that are open together share the memory for documents", "[quick][io]") {
  const TempDir dir;
  (void)dir.file("a.glb", content());
  const auto with_many = [](const std::string& uri) {
    Json children = Json::array({tile(uri)});
    for (int i = 0; i < 700; ++i) children.push_back(tile(""));
    return tileset(tile("", 0, children));
  };
  const std::string inner = dir.file("inner.json", with_many("a.glb")),
                    outer = dir.file("t.json", with_many("inner.json"));
  SceneOptions options;
  options.document.bytes = std::uint64_t(1) << 20;
  CHECK(read_all(inner, options).size() == 1);
  CHECK_THAT(complaint_of(outer, options), Contains("wrong code") && Contains("inner.json: its JSON takes"));
  options.document.bytes *= 2;
  CHECK(read_all(outer, options).size() == 1);
  const std::string twice = dir.file("t.json", tileset(tile("", 0, {tile("inner.json"), tile("inner.json")})));
  options.document.bytes /= 2;
  CHECK(read_all(twice, options).size() == 2);  // one after the other
}

TEST_CASE("a tileset that needs an extension is read if that is known", "[quick][io]") {
  const TempDir dir;
  (void)dir.file("a.glb", content());
  Json json = Json::parse(tileset(tile("a.glb")));
  json["extensionsUsed"] = {"VENDOR_unknown"};
  json["extensionsRequired"] = {"3DTILES_content_gltf", "3DTILES_bounding_volume_S2", "3DTILES_metadata"};
  CHECK(drawn(dir.file("known.json", json.dump())) == "0 ");
  json["extensionsRequired"].push_back("VENDOR_unknown");
  CHECK_THAT(complaint_of(dir.file("t.json", json.dump())), Contains("requires \"VENDOR_unknown\", which is not read"));
  CHECK_THAT(complaint_of(dir.file("outer.json", tileset(tile("t.json")))), Contains("VENDOR_unknown"));
}

TEST_CASE("a tileset that is not whole is no scene", "[quick][io]") {
  const TempDir dir;
  (void)dir.file("a.glb", content());
  const auto complaint = [&](const Json& root) { return complaint_of(dir.file("t.json", tileset(root))); };
  CHECK_THAT(complaint(tile("", 0, {tile("a.glb"), tile("b.glb"), tile("c.glb")})),
             Contains("2 of 3 contents are missing") && Contains("b.glb"));
  (void)dir.file("points", "pnts" + raw(1U));
  CHECK_THAT(complaint(tile("points")), Contains("neither glTF nor b3dm"));
  (void)dir.file("cut.b3dm", b3dm("").substr(0, 40));
  CHECK_THAT(complaint(tile("cut.b3dm")), Contains("truncated"));
  (void)dir.file("far.b3dm", b3dm(R"({"RTC_CENTER":{"byteOffset":4}})"));
  CHECK_THAT(complaint(tile("far.b3dm")), Contains("RTC_CENTER"));
  CHECK_THAT(complaint(tile("https://x/a.glb")), Contains("network"));
  Json implicit = tile("a.glb");
  implicit["implicitTiling"] = Json::object();
  CHECK_THAT(complaint(implicit), Contains("implicitly"));
  Json several = tile("a.glb");
  several["extensions"]["3DTILES_multiple_contents"]["contents"] = {{{"uri", "a.glb"}}};
  CHECK_THAT(complaint(several), Contains("contents in an extension"));
  SceneOptions tight;
  tight.document.bytes = 100;
  CHECK_THROWS_AS(open_scene(dir.file("t.json", tileset(tile("a.glb"))), tight), Error);
}

TEST_CASE("a content is a regular file: nobody waits for a pipe", "[quick][io]") {
  const TempDir dir;
  const std::string pipe = dir.path("c.glb");
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  CHECK_THROWS_WITH(read_tile_content(pipe, {}, {}), Contains("is a pipe or a device"));
}

TEST_CASE("of several files the limit that a refusal names has room for each", "[quick][io]") {
  const TempDir dir;
  const auto scene = [&](const char* name, int nodes) {
    Document d;
    const int mesh = d.quad_mesh();
    for (int i = 0; i < nodes; ++i) {
      d.node({{"mesh", mesh}, {"translation", {i, 0, 0}}});
      d.json["scenes"][0]["nodes"][std::size_t(i)] = i;
    }
    return dir.file(name, d.glb());
  };
  const std::vector<std::string> files{scene("a.glb", 3), scene("b.glb", 4000), scene("c.glb", 9000),
                                       scene("d.glb", 2)};
  std::string text =
      R"({"asset":{"version":"1.1"},"geometricError":9,"root":{"refine":"ADD","geometricError":1,"children":[)";
  for (const char* name : {"a", "b", "c", "d"})
    text += fmt::format(R"({}{{"geometricError":1,"content":{{"uri":"{}.glb"}}}})", *name == 'a' ? "" : ",", name);
  const std::string tileset = dir.file("t.json", text + "]}}");
  for (const auto& paths : {files, std::vector<std::string>{tileset}}) {
    SceneOptions options;
    const auto refused_at = [&](std::uint64_t bytes) -> std::uint64_t {
      const MemoryLimit limit{bytes, std::uint64_t(1) << 20};
      options.document = {limit.rest_bytes() / 2, 0.5, limit};
      options.memory_bytes = limit.rest_bytes() / 10;
      try {
        const std::size_t triangles = read_all(*open_scenes(paths, options)).size();
        CHECK(triangles == 26010);
      } catch (const Error& e) {
        return e.memory_bytes();
      }
      return 0;
    };
    const std::uint64_t named = refused_at(std::uint64_t(3) << 20);
    CHECK(named > std::uint64_t(6) << 20);
    CHECK(refused_at(named) == 0);
    CHECK(refused_at(named / 4 * 3) > 0);
  }
}
