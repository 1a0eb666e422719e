#include "io/gltf/glb_file.h"

#include <limits>

#include "lib/core/error.h"

namespace bp {

namespace {

constexpr double kGrey = 0.6;  // linear light

std::string little_endian(std::uint64_t x) {
  std::string bytes(4, '\0');
  for (int i = 0; i < 4; ++i) bytes[std::size_t(i)] = char(x >> (8 * i));
  return bytes;
}

}  // namespace

GltfOutJson gltf_asset(const std::string& tool, const std::vector<Provenance>& provenance, UpAxis up,
                       const Vec3d& origin, const std::string& contract) {
  GltfOutJson steps = GltfOutJson::array();
  for (const Provenance& p : provenance) {
    GltfOutJson step{{"tool", p.tool}, {"version", p.version}, {"options", p.options}};
    if (!p.input_hash.empty()) step["input"] = p.input_hash;
    steps.push_back(std::move(step));
  }
  GltfOutJson extras{{"up", name_of(up)}};
  if (origin != Vec3d{}) extras["origin"] = origin;
  if (!contract.empty()) extras["contract"] = contract;
  extras["provenance"] = std::move(steps);
  return {{"version", "2.0"}, {"generator", tool + " " BP_VERSION}, {"extras", std::move(extras)}};
}

GltfOutJson gltf_material(bool colored) {
  const double c = colored ? 1 : kGrey;
  return {{"name", colored ? "matte vertex colors" : "matte grey"},
          {"pbrMetallicRoughness",
           {{"baseColorFactor", GltfOutJson::array({c, c, c, 1})}, {"metallicFactor", 0}, {"roughnessFactor", 1}}}};
}

GltfOutJson gltf_textured_material(const GltfTextures& textures, bool has_holes) {
  GltfOutJson pbr;
  if (textures.color) {
    pbr["baseColorTexture"] = {{"index", *textures.color}};
  } else {
    pbr["baseColorFactor"] = GltfOutJson::array({kGrey, kGrey, kGrey, 1});
  }
  const bool plain = !textures.roughness;
  if (plain && textures.metal_factor == 0) pbr["metallicFactor"] = 0;
  if (plain && textures.metal_factor != 0) pbr["metallicFactor"] = textures.metal_factor;
  if (plain && textures.roughness_factor == 1) pbr["roughnessFactor"] = 1;
  if (plain && textures.roughness_factor != 1) pbr["roughnessFactor"] = textures.roughness_factor;
  if (!plain) pbr["metallicRoughnessTexture"] = {{"index", *textures.roughness}};
  const bool is_matte = plain && textures.metal_factor == 0 && textures.roughness_factor == 1;
  GltfOutJson material{{"name", is_matte ? "matte texture" : "texture"}, {"pbrMetallicRoughness", std::move(pbr)}};
  if (textures.normal) material["normalTexture"] = {{"index", *textures.normal}};
  if (textures.emission) {
    material["emissiveTexture"] = {{"index", *textures.emission}};
    material["emissiveFactor"] = GltfOutJson::array({1, 1, 1});
  }
  if (has_holes) material["alphaMode"] = "MASK";
  return material;
}

std::string glb_head(std::string json, std::size_t data_bytes, const std::string& name) {
  json.append((4 - json.size() % 4) % 4, ' ');
  const std::uint64_t total = 12 + 8 + json.size() + 8 + data_bytes;
  if (total > std::numeric_limits<std::uint32_t>::max())
    fail(ErrorCode::bad_argument, {Remedy::ply_format}, "{}: a GLB is limited to 4 GiB, and this mesh takes {}", name,
         total);
  std::string head = "glTF";
  head.append(little_endian(2)).append(little_endian(total));
  head.append(little_endian(json.size())).append("JSON").append(json);
  head.append(little_endian(data_bytes)).append("BIN\0", 4);
  return head;
}

void write_glb(std::string json, const std::string& data, OutputFile& out) {
  out.write(glb_head(std::move(json), data.size(), out.name()));
  out.write(data);
}

}  // namespace bp
