#include "io/mesh/leaf_writer.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "io/gltf/gltf_sampler.h"
#include "io/mesh/contract.h"
#include "io/mesh/detail/glb_data.h"

namespace bp {

namespace {

using Json = GltfOutJson;

template <class Number>
void append(std::string& bytes, const Number& x) {
  bytes.append(reinterpret_cast<const char*>(&x), sizeof x);
}

/// The arrays of one primitive: vertices in the order of the file.
class LeafPrimitive {
 public:
  LeafPrimitive(const LeafPart& part, UpAxis up, GlbData& data)
      : part_(part), turn_(to_y_up(up)), data_(data), triangles_(part.triangles) {
    order_ = optimize_order(triangles_, part.vertices.size());
  }

  [[nodiscard]] Json json(bool textured, bool colored) {
    Json attributes{{"POSITION", add_positions()}, {"NORMAL", add_normals()}};
    if (textured) attributes["TEXCOORD_0"] = add_uv();
    if (colored) attributes["COLOR_0"] = add_colors();
    const std::size_t indices = data_.add_indices(triangles_, order_.size());
    return {{"attributes", std::move(attributes)}, {"indices", indices}};
  }

 private:
  std::size_t add_positions() {
    std::array<float, 3> min, max;
    min.fill(HUGE_VALF);
    max.fill(-HUGE_VALF);
    std::string bytes;
    for (const std::uint32_t i : order_) {
      const auto& v = part_.vertices[i].at;
      const std::array<float, 3> p = turn_(std::array<float, 3>{float(v[0]), float(v[1]), float(v[2])});
      for (std::size_t k = 0; k < 3; ++k) {
        min[k] = std::min(min[k], p[k]);
        max[k] = std::max(max[k], p[k]);
      }
      append(bytes, p);
    }
    return data_.add_attributes(
        bytes, 12,
        {{"componentType", kGltfFloat}, {"count", order_.size()}, {"type", "VEC3"}, {"min", min}, {"max", max}});
  }
  std::size_t add_normals() {
    std::vector<std::array<float, 3>> normals;
    normals.reserve(order_.size());
    for (const std::uint32_t i : order_) normals.push_back(turn_(part_.vertices[i].normal));
    return data_.add_normals(normals);
  }
  std::size_t add_uv() {
    std::string bytes;
    for (const std::uint32_t i : order_) append(bytes, part_.vertices[i].uv);
    return data_.add_attributes(bytes, 8, {{"componentType", kGltfFloat}, {"count", order_.size()}, {"type", "VEC2"}});
  }
  std::size_t add_colors() {
    std::string bytes;
    for (const std::uint32_t i : order_) {
      const LinearColor& c = part_.vertices[i].color;
      append(bytes, std::array<std::uint16_t, 4>{c.r, c.g, c.b, 65535});
    }
    return data_.add_attributes(
        bytes, 8, {{"componentType", kGltfUint16}, {"normalized", true}, {"count", order_.size()}, {"type", "VEC4"}});
  }

  const LeafPart& part_;
  const AxisTurn turn_;
  GlbData& data_;
  TriangleIndices triangles_;
  std::vector<std::uint32_t> order_;
};

class LeafBuilder {
 public:
  LeafBuilder(const SceneLeaf& leaf, const LeafLooks& looks, UpAxis up)
      : leaf_(leaf), looks_(looks), up_(up), data_(looks.compression == TileCompression::meshopt) {}

  std::string glb(const std::string& name, const std::vector<Provenance>& provenance) {
    Json primitives = Json::array();
    for (const LeafPart& part : leaf_.parts) {
      primitives.push_back(add_part(part));
      primitives.back()["material"] = materials_.size() - 1;
    }
    Json& doc = data_.json();
    doc["meshes"].push_back({{"name", name}, {"primitives", std::move(primitives)}});
    doc["nodes"].push_back({{"name", name}, {"mesh", 0}, {"scale", Json::array({leaf_.unit, leaf_.unit, leaf_.unit})}});
    doc["materials"] = materials_;
    if (!images_.empty()) {
      for (const std::string& image : images_) doc["images"].push_back({{"uri", image}});
      doc["samplers"] = samplers_;
      doc["textures"] = textures_;
    }
    if (has_webp_) data_.use("EXT_texture_webp", true);
    Json asset = gltf_asset("bplod", provenance, UpAxis::y, {}, name_of(Contract::leaf));
    asset["extras"]["tile_origin"] = leaf_.origin;
    const std::string json = data_.document(std::move(asset), {0});
    return glb_head(json, data_.bytes().size(), name + ".glb") + data_.bytes();
  }

 private:
  Json add_part(const LeafPart& part) {
    const bool known = looks_.images != nullptr && part.material != TriangleTexture::kNoMaterial;
    const TextureMaterial material = known ? looks_.images->material(part.material) : TextureMaterial{};
    const std::string image = material.image == TextureMaterial::kNoImage ? "" : looks_.name_of(material.image);
    const LinearColor first = part.vertices.front().color;
    const bool replaced = !image.empty() && material.replaces_color;
    const bool one_color =
        replaced || !looks_.colors ||
        std::all_of(part.vertices.begin(), part.vertices.end(), [&](const LeafVertex& v) { return v.color == first; });
    std::array<double, 4> factor{1, 1, 1, 1};
    constexpr double kGrey = 0.6;
    if (!looks_.colors) {
      factor = {kGrey, kGrey, kGrey, 1};
    } else if (one_color && !replaced) {
      factor = {first.r / 65535.0, first.g / 65535.0, first.b / 65535.0, 1};
    }
    const bool mapped = add_material(material, image, factor);
    return LeafPrimitive(part, up_, data_).json(mapped, !one_color);
  }

  /// Adds a material; returns whether it has an image.
  bool add_material(const TextureMaterial& material, const std::string& image, std::array<double, 4> factor) {
    const TextureSurface& surface = material.surface;
    Json pbr{{"metallicFactor", surface.metal_factor}, {"roughnessFactor", surface.roughness_factor}};
    if (!image.empty()) pbr["baseColorTexture"] = {{"index", add_texture(image, material.wrap)}};
    if (material.alpha_mode != AlphaMode::opaque) factor[3] = std::clamp(double(material.alpha), 0.0, 1.0);
    if (factor != std::array<double, 4>{1, 1, 1, 1}) pbr["baseColorFactor"] = factor;
    const auto rough = map_of(surface.roughness), normal = map_of(surface.normal), light = map_of(surface.emission);
    if (rough) pbr["metallicRoughnessTexture"] = {{"index", *rough}};
    Json json{{"name", image.empty() ? "the scene's colors" : "the scene's texture"},
              {"pbrMetallicRoughness", std::move(pbr)},
              {"doubleSided", true}};
    if (material.alpha_mode == AlphaMode::mask) {
      json["alphaMode"] = "MASK";
      json["alphaCutoff"] = material.cutoff;
    } else if (material.alpha_mode == AlphaMode::blend) {
      json["alphaMode"] = "BLEND";
    }
    if (normal) json["normalTexture"] = {{"index", *normal}, {"scale", surface.normal_scale}};
    if (light) json["emissiveTexture"] = {{"index", *light}};
    if (surface.emission_factor != std::array<float, 3>{}) json["emissiveFactor"] = surface.emission_factor;
    materials_.push_back(std::move(json));
    return !image.empty() || rough || normal || light;
  }

  std::optional<std::size_t> map_of(const TextureMap& map) {
    const std::string image = map.is_there() && looks_.colors ? looks_.name_of(map.image) : "";
    if (image.empty()) return {};
    return add_texture(image, map.wrap);
  }

  std::size_t add_texture(const std::string& image, const std::array<TextureWrap, 2>& wrap) {
    const auto found = std::find(images_.begin(), images_.end(), image);
    const auto source = std::size_t(found - images_.begin());
    if (found == images_.end()) images_.push_back(image);
    Json texture{{"sampler", number_of(samplers_, gltf_sampler(wrap))}};
    if (image.ends_with(".webp")) {
      has_webp_ = true;
      texture["extensions"] = {{"EXT_texture_webp", {{"source", source}}}};
    } else {
      texture["source"] = source;
    }
    return number_of(textures_, texture);
  }

  /// Returns the number of an element, which is added if it is new.
  static std::size_t number_of(Json& array, const Json& element) {
    const auto found = std::find(array.begin(), array.end(), element);
    const auto number = std::size_t(found - array.begin());
    if (found == array.end()) array.push_back(element);
    return number;
  }

  const SceneLeaf& leaf_;
  const LeafLooks& looks_;
  const UpAxis up_;
  GlbData data_;
  Json materials_ = Json::array(), samplers_ = Json::array(), textures_ = Json::array();
  std::vector<std::string> images_;
  bool has_webp_ = false;
};

}  // namespace

std::string leaf_glb(const std::string& name, const SceneLeaf& leaf, const LeafLooks& looks, UpAxis up,
                     const std::vector<Provenance>& provenance) {
  return LeafBuilder(leaf, looks, up).glb(name, provenance);
}

}  // namespace bp
