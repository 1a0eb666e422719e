#include <cmath>

#include "io/gltf/base64.h"
#include "tests/catch.h"
#include "tests/unit/io/scene/gltf_document.h"

using namespace bp;
using namespace bp::test;

namespace {

std::vector<TriangleD> moved(const std::vector<TriangleD>& triangles, const Vec3d& by) {
  std::vector<TriangleD> all = triangles;
  for (TriangleD& t : all)
    for (Vec3d& p : t)
      for (std::size_t i = 0; i < 3; ++i) p[i] += by[i];
  return all;
}

std::vector<TriangleD> read_glb(const Document& d) {
  const TempDir dir;
  return read_all(dir.file("a.glb", d.glb()));
}
std::string glb_complaint(const Document& d) {
  const TempDir dir;
  return complaint_of(dir.file("a.glb", d.glb()));
}

}  // namespace

TEST_CASE("glTF data may lie in a chunk, in a file or in base64", "[quick][io]") {
  Document d;
  d.node({{"mesh", d.quad_mesh()}});
  const TempDir dir;
  CHECK(read_all(dir.file("a.glb", d.glb())) == kQuadFan);
  (void)dir.file("b c.bin", d.bytes);
  CHECK(read_all(dir.file("b.gltf", d.gltf("b%20c.bin"))) == kQuadFan);
  const std::string embedded = d.gltf("data:application/octet-stream;base64," + base64_of(d.bytes));
  CHECK(read_all(dir.file("c.gltf", embedded)) == kQuadFan);
  CHECK(read_all(dir.file("no extension", embedded)) == kQuadFan);
  std::string escaped;
  for (const char c : embedded) escaped += c == '/' ? "\\/" : std::string(1, c);
  CHECK(read_all(dir.file("d.gltf", escaped)) == kQuadFan);
  CHECK_THAT(complaint_of(dir.file("e.gltf", d.gltf("missing.bin"))), Contains("missing.bin"));
  CHECK_THAT(complaint_of(dir.file("f.gltf", d.gltf("data:application/gltf-buffer;base64,AA$A"))), Contains("base64"));
  CHECK_THAT(complaint_of(dir.file("g.gltf", d.gltf("https://example.org/a.bin"))), Contains("network"));
}

TEST_CASE("glTF reads every type of index, in every mode", "[quick][io]") {
  Document d;
  const int positions = d.quad();
  int indices = 0;
  SECTION("bytes") {
    indices = d.array<std::uint8_t>({0, 1, 2, 0, 2, 3}, kU8, "SCALAR", 6);
  }
  SECTION("shorts") {
    indices = d.array<std::uint16_t>({0, 1, 2, 0, 2, 3}, kU16, "SCALAR", 6);
  }
  SECTION("words") {
    indices = d.array<std::uint32_t>({0, 1, 2, 0, 2, 3}, kU32, "SCALAR", 6);
  }
  d.node({{"mesh", d.mesh(positions, indices, 4)}});
  CHECK(read_glb(d) == kQuadFan);
}

TEST_CASE("glTF strips, fans and plain corners become triangles", "[quick][io]") {
  Document d;
  const TriangleD a{kQuad[0], kQuad[1], kQuad[2]}, b{kQuad[2], kQuad[1], kQuad[3]};
  SECTION("strip") {
    d.node({{"mesh", d.mesh(d.quad(), -1, 5)}});
    CHECK(read_glb(d) == std::vector<TriangleD>{a, b});
  }
  SECTION("fan") {
    d.node({{"mesh", d.mesh(d.quad(), d.array<std::uint16_t>({0, 1, 2, 3}, kU16, "SCALAR", 4), 6)}});
    CHECK(read_glb(d) == kQuadFan);
  }
  SECTION("no indices") {
    d.node({{"mesh", d.mesh(d.floats({kQuad[0], kQuad[1], kQuad[2], kQuad[0], kQuad[2], kQuad[3]}))}});
    CHECK(read_glb(d) == kQuadFan);
  }
  SECTION("lines alone, which are no surface") {
    d.node({{"mesh", d.mesh(d.quad(), -1, 3)}});
    CHECK_THROWS_WITH(read_glb(d), Contains("1 line; lines need a thickness first"));
  }
  SECTION("points alone, which are no surface") {
    d.node({{"mesh", d.mesh(d.quad(), -1, 0)}});
    CHECK_THROWS_WITH(read_glb(d), Contains("4 points; a point cloud needs a surface first"));
  }
  SECTION("points beside triangles") {
    d.node({{"mesh", d.mesh(d.quad(), -1, 0)}, {"children", {1}}});
    d.node({{"mesh", d.mesh(d.quad(), -1, 5)}});
    CHECK(read_glb(d) == std::vector<TriangleD>{a, b});
  }
}

TEST_CASE("long glTF strips are the same through every window of indices", "[quick][io]") {
  Document d;
  std::vector<Vec3d> points;
  std::vector<std::uint32_t> indices;
  for (std::uint32_t i = 0; i < 10001; ++i) {
    points.push_back({double(i), double(i % 2), double(i * i % 7)});
    indices.push_back(i);
  }
  const int positions = d.floats(points);
  d.node({{"mesh", d.mesh(positions, d.array(indices, kU32, "SCALAR", indices.size()), 5)}});
  const auto read = read_glb(d);
  REQUIRE(read.size() == 9999);
  for (std::size_t i = 0; i < read.size(); ++i) {
    const std::size_t odd = i % 2;
    REQUIRE(read[i] == TriangleD{points[i + odd], points[i + 1 - odd], points[i + 2]});
  }
}

TEST_CASE("quantized glTF positions are scaled in double", "[quick][io]") {
  Document d;
  std::string data;
  for (const Vec3d& p : kQuad)
    data += raw(std::int16_t(p[0] * 32767)) + raw(std::int16_t(p[1] * 32767)) + raw(std::int16_t(-32768)) + "xx";
  const int positions = d.accessor(
      {{"bufferView", d.view(data, 8)}, {"componentType", kI16}, {"normalized", true}, {"count", 4}, {"type", "VEC3"}});
  const int bytes = d.array<std::int8_t>({0, 0, 0, 127, 0, 0, 127, 127, -128}, kI8, "VEC3", 3);
  d.node({{"mesh", d.mesh(positions, -1, 6)}, {"children", {1}}});
  d.node({{"mesh", d.mesh(bytes)}});
  const auto read = read_glb(d);
  REQUIRE(read.size() == 3);
  CHECK(std::vector<TriangleD>(read.begin(), read.begin() + 2) == moved(kQuadFan, {0, 0, -1}));
  CHECK(read[2][2] == Vec3d{127, 127, -128});
}

TEST_CASE("sparse glTF accessors replace what stands in the view", "[quick][io]") {
  Document d;
  std::string numbers = raw(std::uint16_t(1)) + raw(std::uint16_t(3)), values;
  for (const float c : {5.f, 0.f, 0.f, 0.f, 7.f, 0.f}) values += raw(c);
  const Json sparse{{"count", 2},
                    {"indices", {{"bufferView", d.view(numbers)}, {"componentType", kU16}}},
                    {"values", {{"bufferView", d.view(values)}}}};
  const int over = d.quad();
  d.json["accessors"][std::size_t(over)]["sparse"] = sparse;
  const int alone = d.accessor({{"componentType", kF32}, {"count", 4}, {"type", "VEC3"}, {"sparse", sparse}});
  d.node({{"mesh", d.mesh(over, -1, 6)}, {"children", {1}}});
  d.node({{"mesh", d.mesh(alone, d.array<std::uint8_t>({2, 1, 3}, kU8, "SCALAR", 3))}});
  const auto read = read_glb(d);
  REQUIRE(read.size() == 3);
  CHECK(read[0] == TriangleD{{{0, 0, 0}, {5, 0, 0}, {1, 1, 0}}});
  CHECK(read[1] == TriangleD{{{0, 0, 0}, {1, 1, 0}, {0, 7, 0}}});
  CHECK(read[2] == TriangleD{{{0, 0, 0}, {5, 0, 0}, {0, 7, 0}}});
}

TEST_CASE("glTF nodes nest, and one mesh may stand in many places", "[quick][io]") {
  Document d;
  const int mesh = d.quad_mesh();
  d.node({{"children", {1, 2, 4}}, {"translation", {100, 0, 0}}});
  d.node({{"mesh", mesh}, {"scale", {2, 2, 2}}});
  d.node({{"children", {3}},
          {"matrix", {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1}}});  // a quarter turn around z, up by 5
  d.node({{"mesh", mesh}, {"translation", {0, 10, 0}}});
  d.node({{"mesh", mesh}, {"rotation", {0, 0, std::sqrt(0.5), std::sqrt(0.5)}}});
  const TempDir dir;
  const auto source = open_scene(dir.file("a.glb", d.glb()));
  const auto read = read_all(*source);
  REQUIRE(read.size() == 6);
  CHECK(source->counts().instances == 3);
  CHECK(read[0] == TriangleD{{{100, 0, 0}, {102, 0, 0}, {102, 2, 0}}});
  CHECK(read[2] == TriangleD{{{90, 0, 5}, {90, 1, 5}, {89, 1, 5}}});
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < 3; ++i)
      CHECK(std::abs(read[4][k][i] - TriangleD{{{100, 0, 0}, {100, 1, 0}, {99, 1, 0}}}[k][i]) < 1e-14);
  source->rewind();
  CHECK(read_all(*source) == read);
  CHECK(source->counts().instances == 3);
}

TEST_CASE("a mirrored glTF node keeps the outside outside", "[quick][io]") {
  Document d;
  d.node({{"mesh", d.quad_mesh()}, {"scale", {-1, 1, 1}}});
  CHECK(read_glb(d)[0] == TriangleD{{{0, 0, 0}, {-1, 1, 0}, {-1, 0, 0}}});
}

TEST_CASE("glTF transforms are composed in double", "[quick][io]") {
  Document d;
  const Vec3d far{6801760.123456789, -455564.98765432101, 0.1};
  d.node({{"children", {1}}, {"translation", far}});
  d.node({{"mesh", d.quad_mesh()}});
  CHECK(read_glb(d)[0] == TriangleD{{far, {far[0] + 1, far[1], far[2]}, {far[0] + 1, far[1] + 1, far[2]}}});
}

TEST_CASE("EXT_mesh_gpu_instancing is streamed instance by instance", "[quick][io]") {
  Document d;
  const int mesh = d.quad_mesh(), translation = d.floats({{0, 0, 0}, {0, 0, 3}, {4, 0, 0}}),
            scale = d.floats({{1, 1, 1}, {2, 2, 2}, {-1, 1, 1}});
  d.node({{"mesh", mesh},
          {"translation", {0, 0, 50}},
          {"extensions",
           {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", translation}, {"SCALE", scale}}}}}}}});
  const TempDir dir;
  const auto source = open_scene(dir.file("a.glb", d.glb()));
  const auto read = read_all(*source);
  REQUIRE(read.size() == 6);
  CHECK(source->counts().instances == 3);
  CHECK(read[0] == moved(kQuadFan, {0, 0, 50})[0]);
  CHECK(read[2] == TriangleD{{{0, 0, 53}, {2, 0, 53}, {2, 2, 53}}});
  CHECK(read[4] == TriangleD{{{4, 0, 50}, {3, 1, 50}, {3, 0, 50}}});
}

TEST_CASE("glTF shows the default scene, or all trees where there is none", "[quick][io]") {
  Document d;
  const int mesh = d.quad_mesh();
  d.node({{"mesh", mesh}});
  d.node({{"mesh", mesh}, {"translation", {0, 0, 1}}, {"children", {2}}});
  d.node({{"mesh", mesh}, {"translation", {0, 0, 1}}});
  d.json["scenes"] = Json::array({{{"nodes", {0}}}, {{"nodes", {1}}}});
  d.json["scene"] = 1;
  CHECK(read_glb(d).size() == 4);
  d.json.erase("scene");
  CHECK(read_glb(d) == kQuadFan);
  d.json.erase("scenes");
  CHECK(read_glb(d).size() == 6);
  d.json.erase("nodes");
  CHECK(read_glb(d).empty());
}

TEST_CASE("glTF indices without a vertex are counted as bad faces", "[quick][io]") {
  Document d;
  d.node({{"mesh", d.mesh(d.quad(), d.array<std::uint16_t>({0, 1, 2, 0, 1, 4, 0, 1, 65535, 3}, kU16, "SCALAR", 10))}});
  const TempDir dir;
  const SceneCounts counts = counts_of(dir.file("a.glb", d.glb()));
  CHECK(counts.triangles == 1);
  CHECK(counts.bad_faces == 3);  // two triangles, and the odd corner
}

TEST_CASE("broken glTF is refused with the place that is wrong", "[quick][io]") {
  Document d;
  d.node({{"mesh", d.quad_mesh()}});
  const auto broken = [&](const std::string& pointer, const Json& value) {
    Document copy = d;
    copy.json[Json::json_pointer(pointer)] = value;
    return glb_complaint(copy);
  };
  CHECK_THAT(broken("/nodes/0/mesh", 7), Contains("names meshes[7], but has 1"));
  CHECK_THAT(broken("/nodes/0/mesh", -1), Contains("nodes[0] has a 'mesh' that is not a whole number"));
  CHECK_THAT(broken("/nodes/0/mesh", "x"), Contains("whole number"));
  CHECK_THAT(broken("/nodes/0/children", {0}), Contains("reached twice"));
  CHECK_THAT(broken("/nodes/0/children", {5}), Contains("nodes[5]"));
  CHECK_THAT(broken("/nodes/0/scale", {1, 2}), Contains("3 numbers"));
  CHECK_THAT(broken("/nodes/0/scale", {1, nullptr, 2}), Contains("else than numbers"));
  CHECK_THAT(broken("/scene", 3), Contains("scenes[3]"));
  CHECK_THAT(broken("/accessors/0/count", 1e15), Contains("more than its bufferView"));
  CHECK_THAT(broken("/accessors/0/count", 5), Contains("more than its bufferView"));
  CHECK_THAT(broken("/accessors/0/componentType", 5124), Contains("5124"));
  CHECK_THAT(broken("/accessors/0/type", "VEC2"), Contains("VEC2"));
  CHECK_THAT(broken("/accessors/1/componentType", kF32), Contains("bufferView"));
  CHECK_THAT(broken("/bufferViews/0/byteLength", 1 << 20), Contains("truncated"));
  CHECK_THAT(broken("/bufferViews/0/byteOffset", 9007199254740992.0), Contains("truncated"));
  CHECK_THAT(broken("/bufferViews/0/buffer", 1), Contains("buffers[1]"));
  CHECK_THAT(broken("/meshes/0/primitives/0/mode", 9), Contains("mode 9"));
  for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
    CHECK_THAT(broken("/bufferViews/0/extensions", {{name, Json::object()}}), Contains(name));
  CHECK_THAT(broken("/asset/version", "1.0"), Contains("version 1.0"));
  CHECK_THAT(broken("/meshes", 5), Contains("not an array"));
  CHECK_THAT(broken("/nodes/0", 5), Contains("not an object"));
  CHECK_THAT(broken("/nodes/0/matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 10, 0, 0, 2}), Contains("last row"));
  for (const char* key : {"translation", "rotation", "scale"}) {
    Document both = d;
    both.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    both.json["nodes"][0][key] = {0, 0, 0, 1};
    CHECK_THAT(glb_complaint(both), Contains(std::string("nodes[0] has a matrix and a ") + key));
  }
  Document without = d;
  without.json["accessors"][0].erase("bufferView");
  CHECK_THAT(glb_complaint(without), Contains("no data"));
}

TEST_CASE("glTF that needs an extension is read if that is known, or only changes what it looks like", "[quick][io]") {
  const TempDir dir;
  Document d;
  d.node({{"mesh", d.quad_mesh()}});
  d.json["extensionsUsed"] = {"VENDOR_curves"};
  d.json["extensionsRequired"] = {"KHR_mesh_quantization", "KHR_materials_unlit", "KHR_texture_basisu"};
  CHECK(read_all(dir.file("known.glb", d.glb())).size() == 2);
  d.json["extensionsRequired"].push_back("VENDOR_curves");
  CHECK_THAT(complaint_of(dir.file("other.glb", d.glb())), Contains("requires \"VENDOR_curves\", which is not read"));
  d.json["extensionsRequired"] = {7};
  CHECK_THAT(complaint_of(dir.file("broken.glb", d.glb())), Contains("requires 7"));
}

TEST_CASE("elements without data are held against the bytes of the file", "[quick][io]") {
  Document d;
  d.node({{"mesh", d.quad_mesh()}});
  d.json["accessors"][0].erase("bufferView");
  d.json["accessors"][0]["sparse"] = {
      {"count", 1}, {"indices", {{"bufferView", 0}, {"componentType", kU8}}}, {"values", {{"bufferView", 0}}}};
  CHECK(read_glb(d).size() < 3);  // as many elements as before: legal
  d.json["accessors"][0]["count"] = std::uint64_t(1) << 32;
  CHECK_THAT(glb_complaint(d), Contains("4294967296 elements, and data for 1 of them"));
}

TEST_CASE("a description that needs more than it may take is refused with the figure", "[quick][io]") {
  Document d;
  const int mesh = d.quad_mesh();
  for (int i = 0; i < 20000; ++i) {
    d.node({{"mesh", mesh}, {"translation", {i, 0, 0}}});
    d.json["scenes"][0]["nodes"][std::size_t(i)] = i;
  }
  const TempDir dir;
  const std::string path = dir.file("a.glb", d.glb());
  SceneOptions options;
  const auto complaint = [&] {
    try {
      return fmt::format("{} triangles", read_all(path, options).size());
    } catch (const Error& e) {
      CHECK(e.code() == ErrorCode::out_of_resource);
      CHECK(e.memory_bytes() > options.document.limit.bytes);
      return std::string(e.what());
    }
  };
  options.document.share = 1;
  options.document.limit.bytes = std::uint64_t(128) << 20;
  options.document.bytes = std::uint64_t(1) << 20;
  CHECK_THAT(complaint(), Contains("its JSON takes") && Contains("leaves 1 MiB for it"));
  options.document.bytes = std::uint64_t(64) << 20;
  options.memory_bytes = std::uint64_t(1) << 20;
  CHECK_THAT(complaint(), Contains("the list of its nodes takes 3 MiB, and the limit on memory leaves 1 MiB"));
  options.memory_bytes = std::uint64_t(4) << 20;
  CHECK(complaint() == "40000 triangles");
}

TEST_CASE("a GLB cut anywhere is refused", "[quick][io]") {
  Document d;
  d.node({{"mesh", d.quad_mesh()}});
  const std::string whole = d.glb();
  const TempDir dir;
  for (std::size_t cut = 0; cut < whole.size(); cut += 3) {
    CAPTURE(cut);
    CHECK_THAT(complaint_of(dir.file("cut.glb", whole.substr(0, cut))), Contains("cut.glb"));
  }
  CHECK_THAT(complaint_of(dir.file("v1.glb", "glTF" + raw(1u) + raw(20u) + raw(0u) + raw(0u))), Contains("version 1"));
  CHECK_THAT(complaint_of(dir.file("j.gltf", "{\"asset\": {\"version\": \"2.0\"}")), Contains("JSON"));
}

TEST_CASE("a glTF name in Latin-1 does not matter", "[quick][io]") {
  Document d;
  d.node({{"mesh", d.quad_mesh()}, {"name", "T?r"}});
  const TempDir dir;
  std::string bytes = d.glb();
  bytes[bytes.find("T?r") + 1] = '\xFC';
  CHECK(read_all(dir.file("a.glb", bytes)) == kQuadFan);
}

TEST_CASE("glTF: an object that has a key twice is refused", "[quick][io]") {
  const TempDir dir;
  const std::string head = R"({"asset":{"version":"2.0","generator":"a:\"b: \\"},"extras":{"a":{"b":1},"b":[{"b":2}]})";
  CHECK_THAT(complaint_of(dir.file("a.gltf", head + R"(,"nodes":[{"name":"\u006eo"}]})")), !Contains("twice"));
  CHECK_THAT(complaint_of(dir.file("a.gltf", head + R"(,"nodes":[{"scale":[1,1,1],"sc\u0061le":[2,2,2]}]})")),
             Contains("the key \"scale\" twice"));
  CHECK_THAT(complaint_of(dir.file("a.gltf", head + ",\"\xe9\":1,\"\xe8\":1}")), !Contains("twice"));
  CHECK_THAT(complaint_of(dir.file("a.gltf", head + ",\"\xe9\":1,\"\xe9\":1}")), Contains("twice"));
}

TEST_CASE("a proxy of ours tells which axis points up, other glTF does not", "[quick][io]") {
  const TempDir dir;
  Document d;
  d.node({{"mesh", d.quad_mesh()}});
  const auto up_of = [&](const Json& extras) {
    if (!extras.is_null()) d.json["asset"]["extras"] = extras;
    const std::string path = dir.file("a.glb", d.glb());
    const auto row = open_scenes({dir.file("b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), path});
    for (std::vector<TriangleD> chunk; row->read(chunk);) {
    }
    const std::optional<UpAxis> up = open_scene(path)->up();
    CHECK(read_mesh(path).up == up);
    CHECK(row->up() == up);
    return up;
  };
  CHECK_FALSE(up_of(nullptr).has_value());
  CHECK_FALSE(up_of({{"up", 3}}).has_value());
  const Json record = Json::array();
  CHECK_FALSE(up_of({{"up", "w"}, {"provenance", record}}).has_value());
  for (const char* const name : kUpNames) {
    CHECK_FALSE(up_of({{"up", name}}).has_value());  // somebody else's
    CHECK(up_of({{"up", name}, {"provenance", record}}) == up_axis_named(name));
  }
}

TEST_CASE("glTF extras of others are left alone", "[quick][io]") {
  Document d;
  d.node({{"mesh", d.quad_mesh()}});
  for (const Json& extras : {Json("z"), Json{{"up", 3}}, Json::array({1}), Json{{"up", "y"}}}) {
    d.json["asset"]["extras"] = extras;
    CHECK(read_glb(d) == kQuadFan);
  }
}
