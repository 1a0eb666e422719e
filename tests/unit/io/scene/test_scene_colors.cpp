#include <fmt/format.h>

#include "tests/catch.h"
#include "tests/unit/io/scene/scene_files.h"

using namespace bp;
using namespace bp::test;

namespace {

constexpr LinearColor kRed{65535, 0, 0}, kBlue{0, 0, 65535};

struct Colored {
  std::vector<TriangleD> triangles;
  std::vector<TriangleColors> colors;
  bool any = false;
};

Colored read_colored(TriangleSource& source) {
  Colored all;
  std::vector<TriangleD> batch;
  std::vector<TriangleColors> colors;
  while (source.read_colored(batch, colors)) {
    REQUIRE(colors.size() == batch.size());
    all.triangles.insert(all.triangles.end(), batch.begin(), batch.end());
    all.colors.insert(all.colors.end(), colors.begin(), colors.end());
  }
  all.any = source.has_colors();
  return all;
}

/// With colours asked for; the triangles must be those of a reading without, twice.
Colored read_colored(const std::string& path) {
  SceneOptions options;
  options.colors = true;
  const auto source = open_scene(path, options);
  const Colored first = read_colored(*source);
  source->rewind();
  CHECK(read_colored(*source).colors == first.colors);
  const auto plain = open_scene(path);
  CHECK(read_all(*plain) == first.triangles);
  CHECK_FALSE(plain->has_colors());
  return first;
}

TriangleColors all_of(LinearColor c) {
  return {c, c, c};
}

std::string floats(std::initializer_list<float> values) {
  std::string bytes;
  for (const float v : values) bytes.append(reinterpret_cast<const char*>(&v), sizeof v);
  return bytes;
}

/// A document with a triangle; `attribute` and `more` go into it.
std::string gltf(const std::string& primitive, const std::string& accessors, const std::string& more,
                 std::size_t bytes) {
  return R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[)" +
         primitive + R"(]}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"})" + accessors +
         R"(],"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":)" +
         std::to_string(bytes - 36) + R"(}],"buffers":[{"uri":"t.bin","byteLength":)" + std::to_string(bytes) + "}]" +
         more + "}";
}

const std::string kCorners = floats({0, 0, 0, 1, 0, 0, 0, 1, 0});

}  // namespace

TEST_CASE("colours are kept in linear light and written with the transfer function that is asked for", "[quick][io]") {
  CHECK(color_from_srgb({1, 0, 0}) == kRed);
  CHECK(color_from_srgb({188 / 255.0, 0.5, 0.5}).r == 32957);  // half of the light
  CHECK(srgb_bytes(color_from_linear({0.5, 0, 1})) == std::array<std::uint8_t, 3>{188, 0, 255});
  CHECK(linear_bytes(color_from_linear({0.5, 0, 1})) == std::array<std::uint8_t, 3>{128, 0, 255});
  CHECK(color_from_linear({-1, 7, std::numeric_limits<double>::quiet_NaN()}) == LinearColor{0, 65535, 0});
  for (int i = 0; i < 256; ++i) {
    const double x = i / 255.0;
    CHECK(srgb_bytes(color_from_srgb({x, x, x}))[1] == i);
  }
}

TEST_CASE("OBJ: faces have the Kd of the material in use", "[quick][io]") {
  const TempDir dir;
  (void)dir.file("my mats.mtl",
                 "# mine\nnewmtl a red one\nNs 3\nKd 1 0 0\nnewmtl plain\nnewmtl blue\n  Kd 0 0 1 # b\n");
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  const Colored all = read_colored(dir.file(
      "a.obj", "mtllib my mats.mtl\n" + vertices +
                   "f 1 2 3\nusemtl a red one\nf 1 2 3 4\nusemtl unknown\nf 1 2 4\nusemtl  blue \nf 1 1 2\nf 2 3 4\n"));
  CHECK(all.colors ==
        std::vector<TriangleColors>{all_of(kWhite), all_of(kRed), all_of(kRed), all_of(kWhite), all_of(kBlue)});
  CHECK(all.any);
  CHECK_FALSE(
      read_colored(dir.file("b.obj", "mtllib missing.mtl\nmtllib\n" + vertices + "usemtl blue\nf 1 2 3\n")).any);
  CHECK_FALSE(read_colored(dir.file("c.obj", "mtllib my mats.mtl\n" + vertices + "usemtl plain\nf 1 2 3\n")).any);
}

TEST_CASE("OBJ: of materials of one name the last counts, in the file that was named last", "[quick][io]") {
  const TempDir dir;
  (void)dir.file("a.mtl", "newmtl one\nKd 0 0 1\nnewmtl two\nnewmtl one\nKd 1 0 0\nnewmtl only here\nKd 0 0 1");
  (void)dir.file("b.mtl", "Kd 1 0 0\nnewmtl two\nKd 1 0 0\nnewmtl one\nKd 0 0 1\n");
  const std::string faces = "usemtl one\nf 1 2 3\nusemtl two\nf 1 2 3\nusemtl only here\nf 1 2 3\n";
  const Colored all =
      read_colored(dir.file("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nmtllib a.mtl\n" + faces + "mtllib b.mtl\n" + faces +
                                         "mtllib a.mtl\nmtllib a.mtl\n" + faces));
  CHECK(all.colors == std::vector<TriangleColors>{all_of(kRed), all_of(kWhite), all_of(kBlue), all_of(kBlue),
                                                  all_of(kRed), all_of(kBlue), all_of(kRed), all_of(kWhite),
                                                  all_of(kBlue)});
}

TEST_CASE("OBJ: more materials are used than are kept", "[quick][io]") {
  const TempDir dir;
  constexpr int kMaterials = 5000;  // with names of 1,000 bytes, more than the reader keeps
  const std::string tail(1000, 'x');
  std::string library, scene = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\n";
  for (int i = 0; i < kMaterials; ++i) library += fmt::format("newmtl {}{}\nKd {} 0 0\n", i, tail, i % 2);
  for (int i = 0; i < 2 * kMaterials; ++i) scene += fmt::format("usemtl {}{}\nf 1 2 3\n", i * 7919 % kMaterials, tail);
  (void)dir.file("a.mtl", library);
  const Colored all = read_colored(dir.file("a.obj", scene));
  REQUIRE(all.colors.size() == 2 * kMaterials);
  int wrong = 0;
  for (int i = 0; i < 2 * kMaterials; ++i)
    wrong += all.colors[std::size_t(i)] == all_of(i * 7919 % kMaterials % 2 == 0 ? LinearColor{0, 0, 0} : kRed) ? 0 : 1;
  CHECK(wrong == 0);
}

TEST_CASE("OBJ: what can be seen through is left out where walls are asked for", "[quick][io]") {
  const TempDir dir;
  (void)dir.file("m.mtl",
                 "newmtl glass\nKd 1 0 0\nd 0.4\nnewmtl veil\nTr 0.5\nnewmtl leaf\nmap_d leaf.png\nnewmtl wall\nd 1\n"
                 "newmtl old\nTr 1\n");
  const std::string path =
      dir.file("a.obj",
               "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nusemtl glass\nf 1 2 4\nv 0 0 1\nf 1 2 -1\n"
               "usemtl wall\nf 2 3 4\nusemtl veil\nf 1 2 4\nusemtl leaf\nf 1 2 4\nusemtl old\nf -1 -2 -3\n");
  SceneOptions options;
  CHECK(read_all(*open_scene(path, options)).size() == 7);
  options.walls_only = true;
  const auto source = open_scene(path, options);
  const std::vector<TriangleD> walls = read_all(*source);
  REQUIRE(walls.size() == 3);
  CHECK(walls[1] == TriangleD{Vec3d{1, 0, 0}, Vec3d{1, 1, 0}, Vec3d{0, 1, 0}});
  CHECK(walls[2] == TriangleD{Vec3d{0, 0, 1}, Vec3d{0, 1, 0}, Vec3d{1, 1, 0}});
  source->rewind();
  CHECK(read_all(*source) == walls);
}

TEST_CASE("OBJ: three more numbers of a vertex are its colour", "[quick][io]") {
  const TempDir dir;
  const Colored all = read_colored(
      dir.file("a.obj", "v 0 0 0\nv 1 0 0 1 0 0\nv 1 1 0 0 0 1\nv 0 1 0 0.5\nf 1 2 3\nf 1 -1 5\nv 0 0 1 1 0 0\n"));
  REQUIRE(all.colors.size() == 2);
  CHECK(all.colors[0] == TriangleColors{kWhite, kRed, kBlue});
  CHECK(all.colors[1] == TriangleColors{kWhite, kWhite, kRed});
}

TEST_CASE("glTF: what can be seen through is left out where walls are asked for", "[quick][io]") {
  const TempDir dir;
  const std::string materials =
      R"(,"materials":[{"alphaMode":"BLEND"},{"alphaMode":"MASK"},{"pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.4]}},)"
      R"({"extensions":{"KHR_materials_transmission":{"transmissionFactor":0.5}}},)"
      R"({"alphaMode":"OPAQUE","pbrMetallicRoughness":{"baseColorFactor":[1,0,0,1]}},{},)"
      R"({"extensions":{"KHR_materials_transmission":{}}}])";
  (void)dir.file("t.bin", kCorners);
  SceneOptions options;
  options.walls_only = true;
  for (int material = 0; material < 7; ++material) {
    CAPTURE(material);
    const std::string path = dir.file(
        "a.gltf",
        gltf(R"({"attributes":{"POSITION":0},"material":)" + std::to_string(material) + "}", "", materials, 36));
    CHECK(read_all(*open_scene(path)).size() == 1);
    CHECK(read_all(*open_scene(path, options)).size() == (material < 4 ? 0 : 1));
  }
}

TEST_CASE("glTF: what a node hides is no wall", "[quick][io]") {
  const TempDir dir;
  (void)dir.file("t.bin", kCorners);
  std::string document = gltf(R"({"attributes":{"POSITION":0}})", "", "", 36);
  const std::string plain = R"("nodes":[{"mesh":0}])";
  document.replace(document.find(plain), plain.size(),
                   R"("nodes":[{"children":[1],"extensions":{"KHR_node_visibility":{"visible":false}}},{"mesh":0}])");
  const std::string path = dir.file("a.gltf", document);
  CHECK(read_all(*open_scene(path)).size() == 1);
  SceneOptions options;
  options.walls_only = true;
  CHECK(read_all(*open_scene(path, options)).empty());
}

TEST_CASE("glTF: base colour factor times COLOR_0, linear", "[quick][io]") {
  const TempDir dir;
  const std::string materials =
      R"(,"materials":[{"pbrMetallicRoughness":{"baseColorFactor":[0.5,1,0,1]}},{"name":"plain"},)"
      R"({"extensions":{"KHR_materials_pbrSpecularGlossiness":{"diffuseFactor":[0,0,1,1]}}}])";
  const std::string colors = floats({1, 0, 0, 0, 1, 0, 1, 1, 1});
  (void)dir.file("t.bin", kCorners + colors);
  const std::string accessor = R"(,{"bufferView":1,"componentType":5126,"count":3,"type":"VEC3"})";
  const auto of = [&](const std::string& primitive) {
    return read_colored(dir.file("a.gltf", gltf(primitive, accessor, materials, 72)));
  };
  const Colored both = of(R"({"attributes":{"POSITION":0,"COLOR_0":1},"material":0})");
  REQUIRE(both.colors.size() == 1);
  CHECK(both.colors[0] ==
        TriangleColors{LinearColor{32768, 0, 0}, LinearColor{0, 65535, 0}, LinearColor{32768, 65535, 0}});
  CHECK(of(R"({"attributes":{"POSITION":0},"material":0})").colors[0] == all_of({32768, 65535, 0}));
  CHECK(of(R"({"attributes":{"POSITION":0},"material":2})").colors[0] == all_of(kBlue));
  CHECK_FALSE(of(R"({"attributes":{"POSITION":0},"material":1})").any);
  CHECK_FALSE(of(R"({"attributes":{"POSITION":0}})").any);

  (void)dir.file("t.bin", kCorners + std::string("\xff\0\0\xff\0\0\xff\xff\xff\xff\xff\x7f", 12));
  const Colored bytes = read_colored(dir.file(
      "b.gltf", gltf(R"({"attributes":{"POSITION":0,"COLOR_0":1}})",
                     R"(,{"bufferView":1,"componentType":5121,"normalized":true,"count":3,"type":"VEC4"})", "", 48)));
  CHECK(bytes.colors[0] == TriangleColors{kRed, kBlue, kWhite});
}

TEST_CASE("PLY: red, green and blue of vertices, else of faces", "[quick][io]") {
  const TempDir dir;
  const std::string vertex =
                        "element vertex 3\nproperty float x\nproperty uchar red\nproperty float y\nproperty float z\n"
                        "property uchar green\nproperty uchar blue\n",
                    face = "element face 1\nproperty list uchar int vertex_indices\n";
  const Colored text =
      read_colored(dir.file("a.ply", "ply\nformat ascii 1.0\n" + vertex + face +
                                         "end_header\n0 255 0 0 0 0\n1 0 0 0 0 255\n0 255 1 0 255 255\n"
                                         "3 0 1 2\n"));
  REQUIRE(text.colors.size() == 1);
  CHECK(text.colors[0] == TriangleColors{kRed, kBlue, kWhite});
  CHECK(text.any);

  std::string binary = "ply\nformat binary_little_endian 1.0\n" + vertex + face + "end_header\n";
  const auto add = [&](float x, int r, float y, int g, int b) {
    binary += floats({x}) + char(r) + floats({y, 0}) + char(g) + char(b);
  };
  add(0, 255, 0, 0, 0);
  add(1, 0, 0, 0, 255);
  add(0, 255, 1, 255, 255);
  binary += std::string("\x03\0\0\0\0\x01\0\0\0\x02\0\0\0", 13);
  CHECK(read_colored(dir.file("b.ply", binary)).colors == text.colors);

  const Colored faces = read_colored(
      dir.file("c.ply",
               "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
               "element face 2\nproperty float red\nproperty float green\nproperty list uchar int vertex_indices\n"
               "property float blue\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n1 0 4 0 1 2 3 0\n0 0 3 0 1 2 1\n"));
  CHECK(faces.colors == std::vector<TriangleColors>{all_of(kRed), all_of(kRed), all_of(kBlue)});
}

TEST_CASE("other formats: the diffuse colour of Assimp's materials, as sRGB", "[quick][io]") {
  const TempDir dir;
  const auto ac3d = [](const std::string& rgb) {
    return "AC3Db\nMATERIAL \"m\" rgb " + rgb +
           " amb 0 0 0 emis 0 0 0 spec 0 0 0 shi 0 trans 0\nOBJECT world\nkids 1\nOBJECT poly\nnumvert 3\n0 0 0\n1 0 "
           "0\n"
           "1 1 0\nnumsurf 1\nSURF 0x0\nmat 0\nrefs 3\n0 0 0\n1 0 0\n2 0 0\nkids 0\n";
  };
  const Colored half = read_colored(dir.file("a.ac", ac3d("0.5 0 1")));
  REQUIRE(half.colors.size() == 1);
  CHECK(half.any);
  CHECK(half.colors[0] == all_of(color_from_srgb({0.5, 0, 1})));
  CHECK_FALSE(read_colored(dir.file("b.ac", ac3d("1 1 1"))).any);
}

TEST_CASE("colours stay with their triangles when others are skipped, and in a row of scenes", "[quick][io]") {
  const TempDir dir;
  (void)dir.file("m.mtl", "newmtl r\nKd 1 0 0\nnewmtl b\nKd 0 0 1\n");
  const std::string start = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv nan 0 0\n";
  SceneOptions options;
  options.colors = true;
  const auto row = open_scenes({dir.file("plain.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n"),
                                dir.file("a.obj", start + "usemtl r\nf 1 1 2\nf 1 2 4\nusemtl b\nf 1 2 3\n")},
                               options);
  const Colored all = read_colored(*row);
  CHECK(all.colors == std::vector<TriangleColors>{all_of(kWhite), all_of(kBlue)});
  CHECK(all.any);
}

TEST_CASE("materials of OBJ that do not fit are refused with a limit on memory that will do", "[quick][io]") {
  const TempDir dir;
  const auto library = [&](const std::string& name, int materials) {
    std::string text;
    for (int i = 0; i < materials; ++i) text += "newmtl " + name + std::to_string(i) + "\nKd 1 0 0\n";
    (void)dir.file(name + ".mtl", text);
  };
  library("few", 100);
  library("many", 200000);
  library("more", 100000);
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl few5\nf 1 2 3\n";
  const std::string small = dir.file("small.obj", "mtllib few.mtl\n" + corners);
  // The second file is named behind a face, and counts all the same; what is named again counts once.
  const std::string again = "mtllib more.mtl\nmtllib many.mtl\nf 1 2 3\nmtllib more.mtl\n";
  const std::string large = dir.file("large.obj", "mtllib few.mtl\nmtllib many.mtl\n" + corners + again);
  const auto options_of = [](std::uint64_t memory) {
    SceneOptions options;
    options.colors = true;
    options.document.limit = {memory, std::uint64_t(1) << 20};
    options.document.bytes = options.document.limit.rest_bytes();
    options.document.share = 1;
    return options;
  };
  const auto limit_named = [&](const std::string& path, std::uint64_t memory) -> std::uint64_t {
    try {
      const Colored read = read_colored(*open_scene(path, options_of(memory)));
      CHECK(read.colors.back() == all_of(kRed));
    } catch (const Error& e) {
      CHECK(e.code() == ErrorCode::out_of_resource);
      CHECK_THAT(e.what(), Contains(".mtl: the list of materials takes"));
      return e.memory_bytes();
    }
    return 0;
  };
  constexpr std::uint64_t kSmall = std::uint64_t(8) << 20;
  CHECK(limit_named(small, kSmall) == 0);
  const std::uint64_t limit = limit_named(large, kSmall);
  CHECK(limit > 300000 * 4 * 16);  // materials may take a quarter, and have 16 bytes each
  CHECK(limit < 300000 * 4 * 20);
  CHECK(limit_named(large, limit) == 0);
  const std::uint64_t again_named = limit_named(large, limit - (std::uint64_t(1) << 20));
  CHECK(again_named >= limit);
  CHECK(again_named < limit + 16);
  // Each pass begins without materials.
  const auto source = open_scene(large, options_of(limit));
  for (int pass = 0; pass < 3; ++pass) {
    CHECK(read_colored(*source).triangles.size() == 2);
    source->rewind();
  }
}
