#include <nlohmann/json.hpp>

#include "io/image/texture_writer.h"
#include "io/scene/texture_table.h"
#include "tests/catch.h"
#include "tests/unit/io/scene/scene_files.h"

using namespace bp;
using namespace bp::test;

namespace {

/// The images that a scene names.
std::shared_ptr<TextureTable> images_named_by(const std::string& path) {
  SceneOptions options;
  options.colors = true;
  options.textures = std::make_shared<TextureTable>();
  const auto source = open_scene(path, options);
  std::vector<TriangleD> triangles;
  std::vector<TriangleColors> colors;
  std::vector<TriangleTexture> textures;
  while (source->read_textured(triangles, colors, textures)) continue;
  return options.textures;
}

/// A triangle whose material has an image of this name.
std::string obj_with_image(const TempDir& dir, const std::string& image) {
  (void)dir.file("m.mtl", "newmtl a\nmap_Kd " + image + "\n");
  return dir.file("x.obj", "mtllib \"M.mtl\"\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\n");
}

std::string small_image() {
  return encode_texture(TextureImage(4, 2, {255, 0, 0, 255})).bytes;
}

/// A triangle whose texture is in KTX2 alone, or has a PNG, too.
std::string gltf_with_ktx2(bool fallback) {
  nlohmann::json doc;
  doc["asset"]["version"] = "2.0";
  doc["extensionsUsed"] = {"KHR_texture_basisu"};
  doc["buffers"] = {{{"byteLength", 36}, {"uri", "data:application/octet-stream;base64," + std::string(48, 'A')}}};
  doc["bufferViews"] = {{{"buffer", 0}, {"byteLength", 36}}};
  doc["accessors"] = {{{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}},
                      {{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "VEC2"}}};
  doc["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}}}, {"material", 0}}}}}};
  doc["nodes"] = {{{"mesh", 0}}};
  doc["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
  doc["images"] = {{{"uri", "wall.ktx2"}}, {{"uri", "wall.png"}}};
  doc["textures"] = {{{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}}};
  if (fallback) doc["textures"][0]["source"] = 1;
  return doc.dump();
}

}  // namespace

TEST_CASE("OBJ: images and materials are found by the names that other programs give them", "[quick][io]") {
  const TempDir dir;
  (void)dir.file("brick wall.png", small_image());
  for (const char* const name : {"brick wall.png", "\"brick wall.png\"", "Brick Wall.PNG",
                                 "-s 2 2 2 C:\\tex\\brick wall.png", "/elsewhere/brick wall.png"}) {
    CAPTURE(name);
    const auto images = images_named_by(obj_with_image(dir, name));
    REQUIRE(images->image_count() == 1);
    CHECK(images->size(0) == std::array{4, 2});
    CHECK(images->fault_of(0).empty());
    CHECK(images->image_faults().images == 0);
  }
}

TEST_CASE("an image that cannot be shown has a reason, with its file", "[quick][io]") {
  const TempDir dir;
  const auto fault_of = [&](const std::string& image) {
    const ImageFaults faults = images_named_by(obj_with_image(dir, image))->image_faults();
    CHECK(faults.images == 1);
    return faults.first;
  };
  CHECK(fault_of("C:\\tex\\gone.png") == dir.path("gone.png") + ": the image is not there");
  const std::pair<std::string, const char*> kinds[] = {{std::string("II*\0 and so on", 14), "it is TIFF"},
                                                       {std::string("MM\0* and so on", 14), "it is TIFF"},
                                                       {"DDS and so on", "it is DDS"},
                                                       {"\xABKTX 20\xBB\r\n", "it is KTX2"},
                                                       {"BM and so on", "it is BMP"},
                                                       {"what is this?", "it is no PNG"}};
  for (const auto& [bytes, reason] : kinds) {
    const std::string path = dir.file("roof.img", bytes);
    CHECK_THAT(fault_of("roof.img"), Contains(path + ": the image cannot be read: " + reason));
  }
}

TEST_CASE("glTF: of a texture in KTX2 alone that is the reason, and another source is read", "[quick][io]") {
  const TempDir dir;
  (void)dir.file("wall.ktx2", "\xABKTX 20\xBB\r\n");
  (void)dir.file("wall.png", small_image());
  const auto alone = images_named_by(dir.file("alone.gltf", gltf_with_ktx2(false)));
  CHECK_FALSE(alone->has_images());
  CHECK_THAT(alone->image_faults().first, Contains("wall.ktx2: the image cannot be read: it is KTX2"));
  CHECK(images_named_by(dir.file("both.gltf", gltf_with_ktx2(true)))->image_faults().images == 0);
}
