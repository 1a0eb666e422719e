#include "lib/core/vec3.h"
#include "tests/unit/io/scene/gltf_document.h"
#include "tests/unit/io/scene/moved_points.h"

using namespace bp;
using namespace bp::test;

namespace {

/// Two parts with normals; the second stands turned, stretched and moved.
Document two_parts() {
  Document d;
  const int first = d.quad_mesh(), second = d.quad_mesh();
  for (const int mesh : {first, second}) {
    const int normals = d.floats({{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}});
    const int colors = d.floats({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}});
    Json& attributes = d.json["meshes"][std::size_t(mesh)]["primitives"][0]["attributes"];
    attributes["NORMAL"] = normals;
    attributes["COLOR_0"] = colors;
  }
  d.json["scenes"][0]["nodes"] = {0, 1};
  d.node({{"mesh", first}, {"name", "a\xC3\xA4"}});
  d.node({{"mesh", second}, {"translation", {5, 0, 0}}, {"rotation", {0.5, 0.5, 0.5, 0.5}}, {"scale", {2, 1, 4}}});
  return d;
}

}  // namespace

TEST_CASE("a GLB whose points stay keeps all but the layout of its JSON", "[io][deform][quick]") {
  const TempDir dir;
  const std::string path = dir.file("a.glb", two_parts().glb());
  const std::string after = moved(dir, path, [](PointBatch&) {});
  CHECK(points_of(dir.file("b.glb", after)) == points_of(path));
  const std::string data = two_parts().bytes;
  CHECK(after.find(data) != std::string::npos);
  CHECK(after.find("a\xC3\xA4") != std::string::npos);
}

TEST_CASE("the points of a GLB move in the coordinates of the scene, and normals follow", "[io][deform][quick]") {
  const TempDir dir;
  const std::string path = dir.file("a.glb", two_parts().glb());
  std::vector<Vec3d> expected = points_of(path), normals;
  for (Vec3d& p : expected) p = {p[0] + 1, 2 * p[1], p[2]};
  const std::string after = moved_file(dir, path, [&](PointBatch& batch) {
    for (Vec3d& p : batch.positions) p = {p[0] + 1, 2 * p[1], p[2]};
    for (Vec3d& n : batch.normals) {
      CHECK(std::abs(length(n) - 1) < 1e-6);
      n = {n[2], n[0], n[1]};
      normals.push_back(n);
    }
  });
  const std::vector<Vec3d> found = points_of(after);
  REQUIRE(found.size() == 8);
  for (std::size_t i = 0; i < found.size(); ++i) CHECK(length(found[i] - expected[i]) < 1e-6);
  std::size_t i = 0;
  OutputFile out(dir.path("again.glb"), true);
  open_points(after, {})->write(
      [&](PointBatch& batch) {
        for (const Vec3d& n : batch.normals) CHECK(length(n - normals[i++]) < 1e-6);
      },
      out);
  CHECK(i == 8);
  const auto bounds =
      Json::parse(bytes_of_file(after).substr(20, bytes_of_file(after).find("BIN") - 24))["accessors"][0];
  CHECK(bounds["max"] == Json({2, 2, 0}));
  CHECK(bounds["min"] == Json({1, 0, 0}));
}

TEST_CASE("a mesh that stands in several places moves in each, and the file stays a glTF of the same scene",
          "[io][deform][quick]") {
  const TempDir dir;
  Document d = two_parts();
  d.json["nodes"][1]["mesh"] = 0;
  d.json["scenes"][0]["nodes"] = {0, 1, 2, 3};
  d.node({{"mesh", 1}, {"translation", {0, 9, 0}}});
  d.node({{"mesh", 0}});                                                              // where the first one stands
  d.json["meshes"][1]["primitives"].push_back(d.json["meshes"][0]["primitives"][0]);  // shares accessors
  const std::string path = dir.file("a.glb", d.glb());
  const auto bend = [](Vec3d& p) { p = {p[0] + 0.1 * p[1] * p[1], p[1] + p[2] * p[0], p[2]}; };
  const std::string after = moved_file(dir, path, [&](PointBatch& batch) {
    for (Vec3d& p : batch.positions) bend(p);
  });
  std::vector<TriangleD> expected = read_all(path);
  const std::vector<TriangleD> found = read_all(after);
  REQUIRE(expected.size() == 10);
  REQUIRE(found.size() == expected.size());
  for (std::size_t t = 0; t < found.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      bend(expected[t][i]);
      CHECK(length(found[t][i] - expected[t][i]) < 1e-5);
    }
  }
  CHECK(points_of(path).size() == 16);  // two places and a copy in each of them for what is shared
}

TEST_CASE("a .gltf is written with its moved buffer in it, and keeps the rest", "[io][deform][quick]") {
  const TempDir dir;
  Document d = two_parts();
  d.json["nodes"][0]["name"] = "base64,_";
  d.json["extras"]["far"] = "base64,";
  (void)dir.file("a.bin", d.bytes);
  const std::string path = dir.file("a.gltf", d.gltf("a.bin"));
  OutputFile out(dir.path("moved.gltf"), true);
  open_points(path, {})->write([](PointBatch&) {}, out);
  out.commit();
  CHECK(points_of(out.name()) == points_of(path));
  const Json before = Json::parse(d.gltf("a.bin")), after = Json::parse(bytes_of_file(out.name()));
  CHECK(after["nodes"] == before["nodes"]);
  CHECK(after["meshes"] == before["meshes"]);
  CHECK(after["extras"] == before["extras"]);
  CHECK(after["buffers"][0]["byteLength"] == d.bytes.size());
  CHECK(read_all(out.name()) == read_all(path));
}

TEST_CASE("interleaved positions and normals move side by side", "[io][deform][quick]") {
  const TempDir dir;
  Document d;
  std::string data;
  for (const Vec3d& p : kQuad) {
    for (const double c : p) data += raw(float(c));
    for (const float c : {0.F, 0.F, 1.F}) data += raw(c);
  }
  const int view = d.view(data, 24);
  const int positions = d.accessor({{"bufferView", view}, {"componentType", kF32}, {"count", 4}, {"type", "VEC3"}});
  const int normals =
      d.accessor({{"bufferView", view}, {"byteOffset", 12}, {"componentType", kF32}, {"count", 4}, {"type", "VEC3"}});
  d.mesh(positions);
  d.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = normals;
  d.node({{"mesh", 0}});
  const std::string after = moved_file(dir, dir.file("a.glb", d.glb()), [](PointBatch& batch) {
    for (Vec3d& p : batch.positions) p[2] = 7;
    for (Vec3d& n : batch.normals) n = {0, 1, 0};
  });
  std::string expected;
  for (const Vec3d& p : kQuad) {
    for (const double c : {p[0], p[1], 7.0, 0.0, 1.0, 0.0}) expected += raw(float(c));
  }
  CHECK(bytes_of_file(after).find(expected) != std::string::npos);
}

TEST_CASE("frames become morph targets of an animation, and the scene stays at rest", "[io][deform][quick]") {
  const TempDir dir;
  Document d = two_parts();
  d.node({{"mesh", 0}, {"translation", {0, 0, 3}}});  // the first part once more
  d.json["scenes"][0]["nodes"] = {0, 1, 2};
  const std::string path = dir.file("a.glb", d.glb());
  OutputFile out(dir.path("moving.glb"), true);
  open_points(path, {})->write_frames(
      2, 0.5,
      [](std::size_t frame, PointBatch& batch) {
        for (Vec3d& p : batch.positions) p[0] += frame == 0 ? 0.0 : 7.0;
        for (Vec3d& n : batch.normals) n = frame == 0 ? n : Vec3d{0, 1, 0};
      },
      out);
  out.commit();
  CHECK(read_all(out.name()) == read_all(path));
  const std::string bytes = bytes_of_file(out.name());
  const Json after = Json::parse(bytes.substr(20, bytes.find("BIN") - 24));
  REQUIRE(after["animations"].size() == 1);
  CHECK(after["animations"][0]["channels"].size() == 3);
  for (const Json& mesh : after["meshes"]) {
    CHECK(mesh["weights"] == Json({0, 0}));
    const Json& targets = mesh["primitives"][0]["targets"];
    REQUIRE(targets.size() == 2);
    CHECK(targets[1].contains("NORMAL"));
    CHECK(after["accessors"][targets[0]["POSITION"].get<std::size_t>()]["max"] == Json({0, 0, 0}));
  }
  const Json& first =
      after["accessors"][after["meshes"][0]["primitives"][0]["targets"][1]["POSITION"].get<std::size_t>()];
  CHECK(first["max"] == Json({7, 0, 0}));
  CHECK(first["count"] == 4);
  const std::size_t times = after["animations"][0]["samplers"][0]["input"];
  CHECK(after["accessors"][times]["max"] == Json({0.5}));
}

TEST_CASE("frames of many parts share views, and what does not fit is refused before the work", "[io][deform][quick]") {
  constexpr std::size_t kParts = 1000, kFrames = 20;
  Document d;
  for (std::size_t i = 0; i < kParts; ++i) {
    d.node({{"mesh", d.quad_mesh()}});
    d.json["scenes"][0]["nodes"][i] = i;
  }
  const TempDir dir;
  const std::string path = dir.file("a.glb", d.glb());
  OutputFile out(dir.path("moving.glb"), true);
  std::size_t moves = 0;
  const auto move = [&](std::size_t frame, PointBatch& batch) {
    for (Vec3d& p : batch.positions) p[2] += double(frame);
    ++moves;
  };
  SceneOptions options;
  options.document.bytes = std::uint64_t(32) << 20;
  CHECK_THROWS_AS(open_points(path, options)->write_frames(kFrames, 1, move, out), NeedsMemory);
  CHECK(moves == 0);
  options.document.bytes = std::uint64_t(128) << 20;
  open_points(path, options)->write_frames(kFrames, 1, move, out);
  CHECK(moves == kFrames * kParts);
  out.commit();
  const std::string bytes = bytes_of_file(out.name());
  const Json after = Json::parse(bytes.substr(20, bytes.find(std::string("BIN\0", 4)) - 24));
  CHECK(after["bufferViews"].size() == d.json["bufferViews"].size() + kFrames + 2);  // and times and weights
  const Json& last = after["meshes"][kParts - 1]["primitives"][0]["targets"][kFrames - 1];
  const Json& accessor = after["accessors"][last["POSITION"].get<std::size_t>()];
  const Json& view = after["bufferViews"][accessor["bufferView"].get<std::size_t>()];
  CHECK(accessor["byteOffset"] == (kParts - 1) * 48);
  CHECK(view["byteLength"] == kParts * 48);
  const std::size_t at = bytes.find(std::string("BIN\0", 4)) + 4 + view["byteOffset"].get<std::size_t>();
  CHECK(bytes.substr(at + (kParts - 1) * 48, 12) == raw(0.F) + raw(0.F) + raw(float(kFrames - 1)));
}

TEST_CASE("frames in one file are kept by glTF alone", "[io][deform][quick]") {
  const TempDir dir;
  OutputFile out(dir.path("b.obj"), true);
  CHECK_THROWS_WITH(open_points(dir.file("a.obj", "v 1 2 3\n"), {})->write_frames(1, 1, {}, out),
                    Contains("only glTF"));
}

TEST_CASE("a GLB that cannot keep what it has is refused", "[io][deform][quick]") {
  const TempDir dir;
  const auto refused = [&](const char* why, const auto& change) {
    Document d = two_parts();
    change(d.json);
    CHECK_THROWS_WITH(points_of(dir.file("a.glb", d.glb())), Contains(why));
  };
  refused("has a skin", [](Json& j) { j["nodes"][0]["skin"] = 0; });
  refused("in many places", [](Json& j) { j["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"] = Json::object(); });
  refused("morph targets", [](Json& j) { j["meshes"][0]["primitives"][0]["targets"] = Json::array({Json::object()}); });
  refused("flattens", [](Json& j) { j["nodes"][1]["scale"] = {1, 0, 1}; });
  refused("quantized", [](Json& j) { j["accessors"][0]["componentType"] = kI16; });
  refused("second buffer", [](Json& j) { j["bufferViews"][0]["buffer"] = 1; });
  refused("sparse", [](Json& j) { j["accessors"][0].erase("bufferView"); });
  refused("share bytes", [](Json& j) { j["accessors"][2]["bufferView"] = j["accessors"][0]["bufferView"]; });
}

TEST_CASE("what does not fit the moving of points is refused with one remedy, its own", "[io][deform][quick]") {
  const TempDir dir;
  Document d = two_parts();
  d.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = Json::object();
  try {
    (void)points_of(dir.file("a.glb", d.glb()));
    FAIL("read");
  } catch (const Error& e) {
    CHECK_THAT(e.what(), Contains("unpack it"));
    CHECK(e.remedies().empty());
  }
}

TEST_CASE("the memory that moving a glTF takes is counted before it is there", "[io][deform][quick]") {
  Document d;
  const int shared = d.quad_mesh(), alone = d.quad_mesh();
  Json& primitives = d.json["meshes"][std::size_t(shared)]["primitives"];
  primitives[0]["attributes"]["NORMAL"] = d.floats({{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}});
  primitives[0]["extras"] = {{"text", "\n\"\xC3\xA4"}, {"numbers", {1.5, -2, 1e300, true}}};
  for (int k = 0; k < 20; ++k) {
    Json next = primitives[0];
    next["attributes"] = {{"POSITION", d.quad()}, {"NORMAL", d.floats({{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}})}};
    primitives.push_back(next);
  }
  d.json["scenes"][0]["nodes"] = Json::array();
  for (int i = 0; i < 300; ++i)
    d.json["scenes"][0]["nodes"].push_back(d.node({{"mesh", i == 0 ? alone : shared}, {"translation", {i, 0, 0}}}));
  const TempDir dir;
  const std::string path = dir.file("a.glb", d.glb());
  const std::size_t frames = GENERATE(0, 3);
  SceneOptions options;
  const auto write = [&] {
    OutputFile out(dir.path("moved.glb"), true);
    const auto points = open_points(path, options);
    frames == 0 ? points->write([](PointBatch&) {}, out)
                : points->write_frames(
                      frames, 1, [](std::size_t, PointBatch&) {}, out);
  };
  options.document = {bytes_of_points(path, options, {true, frames}), 1, {std::uint64_t(1) << 30}};
  CHECK_NOTHROW(write());
  options.document.bytes = options.document.bytes / 4 * 3;  // the bound is no more than that above what is taken
  CHECK_THROWS_AS(write(), NeedsMemory);
  options.document.bytes = bytes_of_points(path, options, {});
  std::vector<Vec3d> some;
  CHECK_NOTHROW(open_points(path, options)->read(some));
  CHECK(bytes_of_points(dir.file("a.obj", "v 0 0 0\n"), options, {true, 3}) == 0);
}
