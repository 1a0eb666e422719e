#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "io/gltf/base64.h"
#include "io/image/image_reader.h"
#include "io/image/texture_writer.h"
#include "io/scene/texture_table.h"
#include "tests/catch.h"
#include "tests/unit/io/scene/scene_files.h"

using namespace bp;
using namespace bp::test;

namespace {

using SortedJson = nlohmann::json;

struct TexturedRead {
  std::vector<TriangleD> triangles;
  std::vector<TriangleColors> colors;
  std::vector<TriangleTexture> textures;
  std::shared_ptr<TextureTable> table = std::make_shared<TextureTable>();
  bool has_textures = false;
};

TexturedRead read_textured(const std::vector<std::string>& paths, bool surface = false) {
  TexturedRead r;
  SceneOptions options;
  options.surface = surface;
  options.colors = true;
  options.textures = r.table;
  const auto source = open_scenes(paths, options);
  std::vector<TriangleD> triangles;
  std::vector<TriangleColors> colors;
  std::vector<TriangleTexture> textures;
  for (int pass = 0; pass < 2; ++pass) {  // the second gives the same
    r.triangles.clear(), r.colors.clear(), r.textures.clear();
    while (source->read_textured(triangles, colors, textures)) {
      r.triangles.insert(r.triangles.end(), triangles.begin(), triangles.end());
      r.colors.insert(r.colors.end(), colors.begin(), colors.end());
      r.textures.insert(r.textures.end(), textures.begin(), textures.end());
    }
    source->rewind();
  }
  r.has_textures = source->has_textures();
  REQUIRE(r.textures.size() == r.triangles.size());
  return r;
}

/// Red, with the number of the image as green.
std::string image_file(std::uint8_t number) {
  return encode_texture(TextureImage(4, 2, {255, number, 0, 200})).bytes;
}

std::uint8_t number_of(const TexturedRead& r, std::size_t triangle) {
  return r.table->image(r.table->material(r.textures.at(triangle).material).image, 1 << 20).at(0, 0)[1];
}

/// A triangle with places in images, as glTF; `doc` has textures, images and materials.
std::string gltf_of(SortedJson doc) {
  const float data[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0.25F, 0.5F, 1, 0.5F, 0.25F, 0.75F};
  const auto* const bytes = reinterpret_cast<const char*>(data);
  doc["asset"]["version"] = "2.0";
  doc["buffers"] = {{{"byteLength", sizeof data},
                     {"uri", "data:application/octet-stream;base64," + base64_of(std::string(bytes, sizeof data))}}};
  doc["bufferViews"] = {{{"buffer", 0}, {"byteLength", 36}}, {{"buffer", 0}, {"byteOffset", 36}, {"byteLength", 24}}};
  doc["accessors"] = {{{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}},
                      {{"bufferView", 1}, {"componentType", 5126}, {"count", 3}, {"type", "VEC2"}}};
  const SortedJson all{{"POSITION", 0}, {"TEXCOORD_0", 1}};
  doc["meshes"] = {{{"primitives", {{{"attributes", all}, {"material", 0}}}}}};
  doc["nodes"] = {{{"mesh", 0}}};
  return doc.dump();
}

SortedJson base_color(const SortedJson& info) {
  return {{{"pbrMetallicRoughness", {{"baseColorTexture", info}}}}};
}

constexpr std::array<std::array<float, 2>, 3> kPlaces{{{0.25F, 0.5F}, {1, 0.5F}, {0.25F, 0.75F}}};

}  // namespace

TEST_CASE("glTF: images beside the file, within it, and as text", "[quick][io]") {
  const TempDir dir;
  (void)dir.file("a b.png", image_file(7));
  SortedJson doc{
      {"materials", base_color({{"index", 0}})}, {"textures", {{{"source", 0}}}}, {"images", {{{"uri", "a%20b.png"}}}}};
  const TexturedRead beside = read_textured({dir.file("beside.gltf", gltf_of(doc))});
  CHECK(beside.has_textures);
  CHECK(beside.textures[0].uv == kPlaces);
  CHECK(int(number_of(beside, 0)) == 7);
  CHECK(beside.table->size(0) == std::array{4, 2});
  CHECK(beside.table->has_images());
  doc["images"][0]["uri"] = "data:image/png;base64," + base64_of(image_file(9));
  CHECK(int(number_of(read_textured({dir.file("text.gltf", gltf_of(doc))}), 0)) == 9);
  // Two files: images and materials of each.
  const TexturedRead both = read_textured({dir.path("text.gltf"), dir.path("beside.gltf")});
  CHECK(int(number_of(both, 0)) == 9);
  CHECK(int(number_of(both, 1)) == 7);
}

TEST_CASE("glTF: wrap modes, alpha and KHR_texture_transform", "[quick][io]") {
  const TempDir dir;
  const SortedJson moved{{"offset", {0.5, 0.25}}, {"rotation", 1.5707963267948966}, {"scale", {2, 4}}};
  SortedJson doc{{"materials", base_color({{"index", 0}, {"extensions", {{"KHR_texture_transform", moved}}}})},
                 {"textures", {{{"source", 0}, {"sampler", 0}}}},
                 {"samplers", {{{"wrapS", 33071}, {"wrapT", 33648}}}},
                 {"images", {{{"uri", "none.png"}}}}};
  doc["materials"][0]["alphaMode"] = "MASK";
  doc["materials"][0]["alphaCutoff"] = 0.25;
  doc["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {1, 0, 0, 0.5};
  const TexturedRead r = read_textured({dir.file("x.gltf", gltf_of(doc))});
  const TextureMaterial& m = r.table->material(r.textures[0].material);
  CHECK(m.wrap == std::array{TextureWrap::clamp, TextureWrap::mirror});
  CHECK(m.alpha_mode == AlphaMode::mask);
  CHECK(m.cutoff == 0.25F);
  CHECK(m.alpha == 0.5F);
  CHECK(r.colors[0][0] == LinearColor{65535, 0, 0});
  for (std::size_t k = 0; k < 3; ++k) {  // the extension's own formula: translation * rotation * scale
    const double u = 2 * double(kPlaces[k][0]), v = 4 * double(kPlaces[k][1]);
    CHECK(r.textures[0].uv[k][0] == Approx(0.5 + v));
    CHECK(r.textures[0].uv[k][1] == Approx(0.25 - u));
  }
  // The image is missing: that is found when it is wanted.
  CHECK(r.table->size(m.image) == std::array{0, 0});
  CHECK(r.table->file(m.image).empty());
  CHECK_FALSE(r.table->has_images());
  REQUIRE_THROWS_WITH(r.table->image(m.image, 1000), Contains("none.png"));
}

TEST_CASE("glTF: how a material answers to light, if that is asked for", "[quick][io]") {
  const TempDir dir;
  SortedJson doc{{"textures", {{{"source", 0}}, {{"source", 1}}}},
                 {"images", {{{"uri", "a.png"}}, {{"uri", "b.png"}}}}};
  doc["materials"] = {
      {{"normalTexture", {{"index", 1}, {"scale", 0.5}}},
       {"emissiveTexture", {{"index", 0}, {"texCoord", 1}}},
       {"emissiveFactor", {1, 0.5, 0}},
       {"pbrMetallicRoughness", {{"metallicRoughnessTexture", {{"index", 0}}}, {"roughnessFactor", 0.25}}}}};
  const std::string path = dir.file("x.gltf", gltf_of(doc));
  const TexturedRead plain = read_textured({path});
  CHECK(plain.textures[0].material == TriangleTexture::kNoMaterial);
  const TexturedRead r = read_textured({path}, true);
  CHECK_FALSE(r.has_textures);  // of colours
  CHECK(r.textures[0].uv == kPlaces);
  const TextureSurface& s = r.table->material(r.textures[0].material).surface;
  CHECK(s.normal.is_there());
  CHECK(s.normal_scale == 0.5F);
  CHECK(s.roughness.is_there());
  CHECK(s.roughness_factor == 0.25F);
  CHECK(s.metal_factor == 1);
  CHECK(s.emission_factor == std::array{1.0F, 0.5F, 0.0F});
  CHECK_FALSE(s.emission.is_there());  // it lies elsewhere, which is told
  REQUIRE(r.table->faults().size() == 1);
  CHECK_THAT(*r.table->faults().begin(), ContainsSubstring("other places"));
}

TEST_CASE("OBJ: normals of corners, if they are asked for", "[quick][io]") {
  const TempDir dir;
  const std::string path = dir.file("x.obj",
                                    "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 2\nvn 1 0 0\n"
                                    "f 1//1 2//2 3//-1\nf 1/1/2 2/1 3/1/9\n");
  CHECK(read_textured({path}).textures[0].normals[0] == 0);
  const TexturedRead r = read_textured({path}, true);
  REQUIRE(r.textures.size() == 2);
  CHECK(unpack_normal(r.textures[0].normals[0])[2] == Approx(1));
  CHECK(unpack_normal(r.textures[0].normals[1])[0] == Approx(1));
  CHECK(unpack_normal(r.textures[0].normals[2])[0] == Approx(1));
  CHECK(unpack_normal(r.textures[1].normals[0])[0] == Approx(1));
  CHECK(r.textures[1].normals[1] == 0);
  CHECK(r.textures[1].normals[2] == 0);
}

TEST_CASE("glTF: textures that name what does not exist", "[quick][io]") {
  const TempDir dir;
  const SortedJson info = base_color({{"index", 0}}), textures{{{"source", 0}}}, images{{{"uri", "x.png"}}};
  // The triangles are there all the same, and the fault is told.
  const auto fault_of = [&](const std::string& file) {
    const TexturedRead r = read_textured({dir.file("x.gltf", file)});
    CHECK(r.triangles.size() == 1);
    CHECK_FALSE(r.has_textures);
    REQUIRE(r.table->faults().size() == 1);
    return *r.table->faults().begin();
  };
  CHECK_THAT(fault_of(gltf_of({{"materials", info}})), Contains("textures[0]"));
  CHECK_THAT(fault_of(gltf_of({{"materials", info}, {"textures", textures}})), Contains("images[0]"));
  const std::string whole = gltf_of({{"materials", info}, {"textures", textures}, {"images", images}});
  const auto places = [&](std::string with) {
    return with + whole.substr(whole.find(R"("count":3,"type":"VEC2")") + 9);
  };
  const std::string before = whole.substr(0, whole.find(R"("count":3,"type":"VEC2")"));
  CHECK_THAT(fault_of(before + places(R"("count":300)")), Contains("accessors[1]"));
  CHECK_THAT(fault_of(before + places(R"("count":2)")), Contains("2 places in images for 3 positions"));
  // Without places, or without a source, there is no texture.
  const TexturedRead none =
      read_textured({dir.file("c.gltf", gltf_of({{"materials", base_color({{"index", 0}, {"texCoord", 3}})},
                                                 {"textures", textures},
                                                 {"images", images}}))});
  CHECK_FALSE(none.has_textures);
  CHECK(none.textures[0].material == TriangleTexture::kNoMaterial);
  const TexturedRead empty =
      read_textured({dir.file("d.gltf", gltf_of({{"materials", info}, {"textures", {SortedJson::object()}}}))});
  CHECK(empty.table->material(empty.textures[0].material).image == TextureMaterial::kNoImage);
}

TEST_CASE("what Assimp reads: an image beside the scene, wherever its path once was, and places from below",
          "[quick][io]") {
  const TempDir dir;
  (void)dir.file("wall.png", image_file(5));
  const auto ac3d = [](const std::string& image) {
    return "AC3Db\nMATERIAL \"m\" rgb 0.5 0 1 amb 0 0 0 emis 0 0 0 spec 0 0 0 shi 0 trans 0\nOBJECT world\nkids "
           "1\nOBJECT poly\ntexture \"" +
           image +
           "\"\ntexrep 2 1\nnumvert 3\n0 0 0\n1 0 0\n1 1 0\nnumsurf 1\nSURF 0x0\nmat 0\nrefs 3\n0 0.25 0.5\n1 1 0\n2 "
           "0 1\nkids 0\n";
  };
  for (const char* const image : {"wall.png", "C:\\pictures\\wall.png", "/media/pictures/wall.png"}) {
    CAPTURE(image);
    const TexturedRead r = read_textured({dir.file("x.ac", ac3d(image))});
    REQUIRE(r.triangles.size() == 1);
    REQUIRE(r.has_textures);
    CHECK(int(number_of(r, 0)) == 5);
    std::map<Vec3d, std::array<float, 2>> places;
    for (std::size_t k = 0; k < 3; ++k) places[r.triangles[0][k]] = r.textures[0].uv[k];
    CHECK(places[{0, 0, 0}] == std::array{0.5F, 0.5F});
    CHECK(places[{1, 0, 0}] == std::array{2.0F, 1.0F});
    CHECK(places[{1, 1, 0}] == std::array{0.0F, 0.0F});
    CHECK(r.table->material(r.textures[0].material).replaces_color);
  }
  (void)dir.file("wall.tga", std::string("\0\0\2\0\0\0\0\0\0\0\0\0\1\0\1\0\x18\0\1\2\3", 21));
  const TexturedRead old = read_textured({dir.file("z.ac", ac3d("wall.tga"))});
  CHECK(old.table->size(0) == std::array{1, 1});
  CHECK(old.table->image(0, 1 << 20).at(0, 0) == TextureImage::Texel{3, 2, 1, 255});
  CHECK(old.table->file(0).at(0) == std::byte{0xFF});  // a JPEG now, as viewers want it
  const TexturedRead missing = read_textured({dir.file("y.ac", ac3d("none.png"))});
  CHECK(missing.has_textures);
  CHECK_FALSE(missing.table->has_images());
}

TEST_CASE("OBJ: places of corners, also from the end, and images of map_Kd", "[quick][io]") {
  const TempDir dir;
  (void)dir.file("wall of bricks.png", image_file(3));
  (void)dir.file(
      "m.mtl",
      "newmtl wall\nKd 0.5 0.5 0.5\nmap_Kd -clamp on -s 2 4 1 -o 0.5 wall of bricks.png\nnewmtl plain\nKd 1 0 0\n");
  const std::string path =
      dir.file("x.obj",
               "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.25 0.5\nvt 1 0\nvt 0 1\n"
               "usemtl wall\nf 1/1 2/2 3/3\nf 1/-3/9 2/-2 3/-1\nf 1//5 2 3/99\nusemtl plain\nf 1/1 2/2 3/3\n");
  const TexturedRead r = read_textured({path});
  REQUIRE(r.triangles.size() == 4);
  CHECK(r.has_textures);
  for (const std::size_t i : {0, 1}) {
    CHECK(r.textures[i].uv[0] == std::array{1.0F, -1.0F});  // 2 * 0.25 + 0.5, 1 - 4 * 0.5
    CHECK(r.textures[i].uv[1] == std::array{2.5F, 1.0F});
    CHECK(int(number_of(r, i)) == 3);
  }
  for (const auto& uv : r.textures[2].uv) CHECK(uv == std::array{0.0F, 0.0F});
  CHECK(r.textures[3].material == TriangleTexture::kNoMaterial);
  const TextureMaterial& m = r.table->material(r.textures[0].material);
  CHECK(m.replaces_color);
  CHECK(m.wrap == std::array{TextureWrap::clamp, TextureWrap::clamp});
  CHECK(r.colors[0][0] == color_from_srgb({0.5, 0.5, 0.5}));
}

TEST_CASE("MTL: how a material answers to light, if that is asked for", "[quick][io]") {
  const TempDir dir;
  for (const char* name : {"base.png", "n.png", "pr.png", "ke.png"}) (void)dir.file(name, image_file(1));
  (void)dir.file("m.mtl",
                 "newmtl all\nmap_Kd -s 2 2 1 base.png\nnorm -bm 0.5 -s 2 2 1 n.png\nPr 0.25\nPm 0.5\nKe 1 0 0\n"
                 "newmtl images\nnorm n.png\nmap_Pr -clamp on pr.png\nPr 0.5\nKe 0 0 1\nmap_Ke ke.png\n"
                 "newmtl packed\nmap_Pr pr.png\nmap_Pm pr.png\nnewmtl two\nmap_Pr pr.png\nmap_Pm ke.png\nPm 0.5\n"
                 "newmtl astray\nmap_Kd base.png\nnorm -o 0.5 n.png\nnewmtl gone\nKe 0 1 0\nmap_Ke gone.png\n"
                 "newmtl high\nmap_Bump -bm 0.25 n.png\nnewmtl plain\nKd 1 0 0\n"
                 "newmtl higher\nmap_Bump -bm 4 n.png\nnewmtl same\nbump -bm 0.25 n.png\n");
  const std::vector<std::string> names{"all",  "images", "packed", "two",    "astray",
                                       "gone", "high",   "plain",  "higher", "same"};
  std::string obj = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n";
  for (const std::string& name : names) obj += "usemtl " + name + "\nf 1/1 2/2 3/3\n";
  const std::string path = dir.file("a.obj", obj);
  const TexturedRead r = read_textured({path}, true);
  const auto surface = [&](std::size_t i) { return r.table->material(r.textures.at(i).material).surface; };
  CHECK(surface(0).normal.is_there());
  CHECK(surface(0).normal_scale == 0.5F);
  CHECK(surface(0).roughness_factor == 0.25F);
  CHECK(surface(0).metal_factor == 0.5F);
  CHECK(surface(0).emission_factor == std::array<float, 3>{1, 0, 0});
  CHECK(r.table->material(r.textures[1].material).image == TextureMaterial::kNoImage);
  CHECK(surface(1).roughness.wrap[0] == TextureWrap::clamp);
  CHECK(surface(1).roughness_factor == 1);
  CHECK(surface(1).emission.is_there());
  CHECK(surface(1).emission_factor == std::array<float, 3>{1, 1, 1});
  CHECK(surface(2).roughness.is_there());
  CHECK(surface(2).metal_factor == 1);
  CHECK(surface(3).metal_factor == 0.5F);
  CHECK_FALSE(surface(3).roughness.is_there());
  CHECK(surface(4) == TextureSurface{});
  CHECK(surface(5).emission_factor == std::array<float, 3>{0, 1, 0});
  CHECK(surface(6).normal.is_there());
  CHECK(surface(6).normal_scale == 1);  // the image has its strength
  CHECK(surface(8).normal.image != surface(6).normal.image);
  CHECK(surface(9).normal.image == surface(6).normal.image);
  CHECK(surface(6).normal.image != surface(1).normal.image);  // one of them may be heights
  CHECK(r.textures[7].material == TriangleTexture::kNoMaterial);
  std::string faults;
  for (const std::string& fault : r.table->faults()) faults += fault + "\n";
  for (const char* part : {"n.png: lies at other places", "gone.png: the image is not there",
                           "m.mtl: roughness and metal come from one image"})
    CHECK_THAT(faults, ContainsSubstring(part));
  const TexturedRead colors = read_textured({path});
  CHECK(colors.textures[2].material == TriangleTexture::kNoMaterial);
  TextureSurface light;  // alone
  light.emission_factor = {1, 0, 0};
  CHECK(colors.table->material(colors.textures[0].material).surface == light);
  const TextureSurface& lamp = colors.table->material(colors.textures[1].material).surface;
  CHECK(lamp.emission.is_there());
  CHECK_FALSE(lamp.normal.is_there());
  CHECK(colors.table->faults().size() == 1);  // gone.png
}

TEST_CASE("light of materials is read where surfaces are not asked for", "[quick][io]") {
  const TempDir dir;
  (void)dir.file("a.png", image_file(1));
  SortedJson doc{{"textures", {{{"source", 0}}}}, {"images", {{{"uri", "a.png"}}}}};
  doc["materials"] = {{{"emissiveTexture", {{"index", 0}}},
                       {"emissiveFactor", {1, 0.5, 0}},
                       {"pbrMetallicRoughness", {{"baseColorFactor", {0, 0, 0, 1}}}}}};
  const TexturedRead lamp = read_textured({dir.file("lamp.gltf", gltf_of(doc))});
  CHECK(lamp.has_textures);
  CHECK(lamp.textures[0].uv == kPlaces);
  CHECK(lamp.colors[0][0] == LinearColor{0, 0, 0});
  const TextureMaterial& material = lamp.table->material(lamp.textures[0].material);
  CHECK(material.image == TextureMaterial::kNoImage);
  CHECK(material.surface.emission.is_there());
  CHECK(material.surface.emission_factor == std::array{1.0F, 0.5F, 0.0F});
  // Without an image it is a colour; an image without light says nothing.
  doc["materials"][0].erase("emissiveTexture");
  const std::string plain = dir.file("plain.gltf", gltf_of(doc));
  CHECK(read_textured({plain}).colors[0][0] == LinearColor{65535, 32768, 0});
  CHECK(read_textured({plain}, true).colors[0][0] == LinearColor{0, 0, 0});
  doc["materials"][0]["emissiveTexture"] = {{"index", 0}};
  doc["materials"][0]["emissiveFactor"] = {0, 0, 0};
  CHECK_FALSE(read_textured({dir.file("dark.gltf", gltf_of(doc))}).has_textures);
  (void)dir.file("m.mtl", "newmtl lamp\nKd 0 0 0\nKe 1 0 0\n");
  const std::string obj = dir.file("a.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl lamp\nf 1 2 3\n");
  CHECK(read_textured({obj}).colors[0][0] == LinearColor{65535, 0, 0});
  CHECK(read_textured({obj}, true).colors[0][0] == LinearColor{0, 0, 0});
}

TEST_CASE("MTL: map_Bump is heights where it is grey, and directions where it is not", "[quick][io]") {
  const TempDir dir;
  TextureImage ramp(8, 8), tint(8, 8, {128, 140, 250, 255});
  const bool down = GENERATE(false, true);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      const auto h = std::uint8_t(32 * (down ? y : x));
      ramp.at(x, y) = {h, h, h, 200};  // a PNG
    }
  }
  tint.at(0, 0)[3] = 254;
  (void)dir.file("ramp.png", encode_texture(ramp).bytes);
  (void)dir.file("tint.png", encode_texture(tint).bytes);
  (void)dir.file(
      "m.mtl",
      "newmtl high\nbump -clamp on -bm 1.5 ramp.png\nnewmtl bent\nmap_bump tint.png\nnewmtl said\nnorm ramp.png\n"
      "newmtl steep\nmap_Bump -bm 1e200 ramp.png\n");
  const std::string path =
      dir.file("a.obj",
               "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl high\nf 1/1 2/2 3/3\n"
               "usemtl bent\nf 1/1 2/2 3/3\nusemtl said\nf 1/1 2/2 3/3\nusemtl steep\nf 1/1 2/2 3/3\n");
  const TexturedRead r = read_textured({path}, true);
  const auto image_of = [&](std::size_t i) {
    return r.table->material(r.textures.at(i).material).surface.normal.image;
  };
  const TextureImage high = r.table->image(image_of(0), 1 << 20);
  const double slope = 1.5 * 32.0 / 255, lean = slope / std::sqrt(1 + slope * slope);
  for (const TextureImage::Texel& t : high.texels) {  // uphill is right, or down: it leans left, or up
    CHECK(std::abs(t[0] / 127.5 - 1 - (down ? 0 : -lean)) < 0.01);
    CHECK(std::abs(t[1] / 127.5 - 1 - (down ? lean : 0)) < 0.01);
    CHECK(t[2] > 250);
  }
  const auto file = r.table->file(image_of(0));  // as leaves of tilesets have it: a JPEG
  const TextureImage copy = decode_image(file, "copy", 1 << 20);
  for (std::size_t i = 0; i < copy.texels.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) CHECK(std::abs(int(copy.texels[i][k]) - int(high.texels[i][k])) <= 4);
  CHECK(r.table->image(image_of(1), 1 << 20).texels == tint.texels);
  CHECK(r.table->image(image_of(2), 1 << 20).texels == ramp.texels);
  const TextureImage::Texel cliff = r.table->image(image_of(3), 1 << 20).at(4, 4);
  CHECK(int(cliff[down ? 1 : 0]) == (down ? 255 : 0));
}
