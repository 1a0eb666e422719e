#include <nlohmann/json.hpp>

#include "io/gltf/base64.h"
#include "io/scene/texture_table.h"
#include "tests/catch.h"
#include "tests/unit/io/scene/scene_files.h"

using namespace bp;
using namespace bp::test;

namespace {

using DetailsJson = nlohmann::json;

constexpr std::array<std::array<float, 2>, 3> kDetailPlaces{{{0.25F, 0.5F}, {1, 0.5F}, {0.25F, 0.75F}}};

/// A triangle with an image that does not matter, as glTF.
std::string gltf_with(const DetailsJson& material) {
  const float data[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0.25F, 0.5F, 1, 0.5F, 0.25F, 0.75F};
  const std::string bytes(reinterpret_cast<const char*>(data), sizeof data);
  DetailsJson doc{{"asset", {{"version", "2.0"}}},
                  {"materials", DetailsJson::array({material})},
                  {"textures", {{{"source", 0}, {"sampler", 0}}}},
                  {"samplers", {{{"magFilter", 9728}}}},
                  {"images", {{{"uri", "none.png"}}}}};
  doc["buffers"] = {{{"byteLength", sizeof data}, {"uri", "data:application/octet-stream;base64," + base64_of(bytes)}}};
  doc["bufferViews"] = {{{"buffer", 0}, {"byteLength", 36}}, {{"buffer", 0}, {"byteOffset", 36}, {"byteLength", 24}}};
  doc["accessors"] = {{{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}},
                      {{"bufferView", 1}, {"componentType", 5126}, {"count", 3}, {"type", "VEC2"}}};
  const DetailsJson all{{"POSITION", 0}, {"TEXCOORD_0", 1}};
  doc["meshes"] = {{{"primitives", {{{"attributes", all}, {"material", 0}}}}}};
  doc["nodes"] = {{{"mesh", 0}}};
  return doc.dump();
}

struct DetailsRead {
  std::shared_ptr<TextureTable> table = std::make_shared<TextureTable>();
  std::vector<TriangleD> triangles;
  std::vector<TriangleColors> colors;
  std::vector<TriangleTexture> textures;
  [[nodiscard]] const TextureMaterial& material() const { return table->material(textures.at(0).material); }
};

DetailsRead read_details(const std::string& path, bool details) {
  DetailsRead r;
  SceneOptions options;
  options.surface = options.colors = true;
  options.details = details;
  options.textures = r.table;
  REQUIRE(open_scenes({path}, options)->read_textured(r.triangles, r.colors, r.textures));
  return r;
}

}  // namespace

TEST_CASE("glTF: details of materials are read if they are asked for", "[quick][io]") {
  const TempDir dir;
  const DetailsJson moved{{"KHR_texture_transform", {{"scale", {2, 2}}}}};
  const DetailsJson material{
      {"name", "leaf"},
      {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}},
      {"occlusionTexture", {{"index", 0}, {"strength", 0.5}, {"extensions", moved}}},
      {"extensions",
       {{"KHR_materials_unlit", DetailsJson::object()},
        {"KHR_materials_clearcoat", {{"clearcoatTexture", {{"index", 0}}}}}}},
  };
  const std::string file = dir.file("x.gltf", gltf_with(material));
  CHECK(read_details(file, false).material().details == MaterialDetails{});
  const DetailsRead r = read_details(file, true);
  const TextureMaterial& m = r.material();
  CHECK(m.details.name == "leaf");
  CHECK_FALSE(m.details.double_sided);
  CHECK(m.details.extensions == R"({"KHR_materials_unlit":{}})");
  CHECK(m.details.occlusion.in_second_places);
  CHECK(m.details.occlusion_strength == 0.5F);
  CHECK(m.filters == TextureFilters{0, 9728});
  CHECK(r.textures[0].uv == kDetailPlaces);
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < 2; ++i) CHECK(r.textures[0].second_uv[k][i] == 2 * kDetailPlaces[k][i]);
  CHECK(r.table->faults().size() == 1);  // the clearcoat
}

TEST_CASE("OBJ: materials without images have names if details are asked for", "[quick][io]") {
  const TempDir dir;
  (void)dir.file("a.mtl", "newmtl plain\n");
  const std::string file =
      dir.file("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.5 0.25\nusemtl plain\nf 1/1 2/1 3/1\n");
  CHECK(read_details(file, false).textures.at(0).material == TriangleTexture::kNoMaterial);
  const DetailsRead r = read_details(file, true);
  CHECK(r.material().details.name == "plain");
  CHECK(r.material().details.double_sided);
  CHECK(r.textures[0].uv[0] == std::array{0.5F, 0.75F});
}
