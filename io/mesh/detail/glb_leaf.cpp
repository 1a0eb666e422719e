#include "io/mesh/detail/glb_leaf.h"

#include <algorithm>
#include <cmath>

namespace bp {

namespace {

using Json = GltfOutJson;

template <class Number>
void append(std::string& bytes, const Number& x) {
  bytes.append(reinterpret_cast<const char*>(&x), sizeof x);
}

/// Rounds a place in an image to a 16th of a texel of 4096. Images that repeat more than a hundred times keep theirs.
float rounded(float place) {
  constexpr float kSteps = 65536;
  return std::abs(place) < 128 ? std::nearbyint(place * kSteps) / kSteps : place;
}

/// The arrays of one primitive: vertices in the order of the file.
class LeafPrimitive {
 public:
  LeafPrimitive(const LeafPart& part, UpAxis up, GlbData& data)
      : part_(part), turn_(to_y_up(up)), data_(data), triangles_(part.triangles) {
    order_ = optimize_order(triangles_, part.vertices.size());
  }

  [[nodiscard]] Json json(const GlbLeaves::Place& place, std::size_t places, bool colored) {
    Json attributes{{"POSITION", add_positions(place)}, {"NORMAL", add_normals()}};
    if (places > 0) attributes["TEXCOORD_0"] = add_uv(&LeafVertex::uv);
    if (places > 1) attributes["TEXCOORD_1"] = add_uv(&LeafVertex::second_uv);
    if (colored) attributes["COLOR_0"] = add_colors();
    const std::size_t indices = data_.add_indices(triangles_, order_.size());
    return {{"attributes", std::move(attributes)}, {"indices", indices}};
  }

  /// Returns how many sets of places the vertices have.
  [[nodiscard]] std::size_t places() const {
    return has_places(&LeafVertex::second_uv) ? 2 : has_places(&LeafVertex::uv) ? 1 : 0;
  }

 private:
  std::size_t add_positions(const GlbLeaves::Place& place) {
    std::array<float, 3> min, max;
    min.fill(HUGE_VALF);
    max.fill(-HUGE_VALF);
    std::string bytes;
    for (const std::uint32_t i : order_) {
      const std::array<float, 3> p = turn_(place(part_.vertices[i].at));
      for (std::size_t k = 0; k < 3; ++k) {
        min[k] = std::min(min[k], p[k]);
        max[k] = std::max(max[k], p[k]);
      }
      append(bytes, p);
    }
    return data_.add_floats(bytes, 12, {{"count", order_.size()}, {"type", "VEC3"}, {"min", min}, {"max", max}});
  }
  std::size_t add_normals() {
    std::vector<std::array<float, 3>> normals;
    normals.reserve(order_.size());
    for (const std::uint32_t i : order_) normals.push_back(turn_(part_.vertices[i].normal));
    return data_.add_normals(normals);
  }
  using Places = std::array<float, 2> LeafVertex::*;
  [[nodiscard]] bool has_places(Places places) const {
    return std::any_of(part_.vertices.begin(), part_.vertices.end(),
                       [&](const LeafVertex& v) { return v.*places != std::array<float, 2>{}; });
  }
  std::size_t add_uv(Places places) {
    std::string bytes;
    for (const std::uint32_t i : order_) {
      for (const float x : part_.vertices[i].*places) append(bytes, data_.is_compressed() ? rounded(x) : x);
    }
    return data_.add_floats(bytes, 8, {{"count", order_.size()}, {"type", "VEC2"}});
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

bool have_one_color(const LeafPart& part) {
  return std::all_of(part.vertices.begin(), part.vertices.end(),
                     [&](const LeafVertex& v) { return v.color == part.vertices.front().color; });
}

}  // namespace

Json GlbLeaves::primitives(const SceneLeaf& leaf, const Place& place) {
  Json all = Json::array();
  for (const LeafPart& part : leaf.parts) all.push_back(primitive(part, place));
  return all;
}

Json GlbLeaves::primitive(const LeafPart& part, const Place& place) {
  const bool is_known = looks_.images != nullptr && part.material != TriangleTexture::kNoMaterial;
  const TextureMaterial material = is_known ? looks_.images->material(part.material) : TextureMaterial{};
  const bool is_replaced = material.replaces_color && image_of(material.image).has_value();
  const bool has_one = is_replaced || !looks_.colors || have_one_color(part);
  std::array<double, 4> factor{1, 1, 1, 1};
  constexpr double kGrey = 0.6;
  if (!looks_.colors) {
    factor = {kGrey, kGrey, kGrey, 1};
  } else if (has_one && !is_replaced) {
    const LinearColor c = part.vertices.front().color;
    factor = {c.r / 65535.0, c.g / 65535.0, c.b / 65535.0, 1};
  }
  const Mapped mapped = add_material(material, factor, part.sides);
  LeafPrimitive all(part, up_, data_);
  Json json = all.json(place, std::max(mapped.places, looks_.spare_places ? all.places() : 0), !has_one);
  json["material"] = mapped.material;
  return json;
}

GlbLeaves::Mapped GlbLeaves::add_material(const TextureMaterial& material, std::array<double, 4> factor,
                                          LeafSides sides) {
  const MaterialDetails& details = material.details;
  const TextureSurface& surface = material.surface;
  Json pbr{{"metallicFactor", surface.metal_factor}, {"roughnessFactor", surface.roughness_factor}};
  const auto image = image_of(material.image);
  if (image) pbr["baseColorTexture"] = {{"index", all_.add_texture(*image, material.wrap, material.filters)}};
  if (material.alpha_mode != AlphaMode::opaque) factor[3] = std::clamp(double(material.alpha), 0.0, 1.0);
  if (factor != std::array<double, 4>{1, 1, 1, 1}) pbr["baseColorFactor"] = factor;
  const auto rough = add_map(surface.roughness), normal = add_map(surface.normal), light = add_map(surface.emission);
  const auto shade = add_map(details.occlusion);
  const std::array maps{&rough, &normal, &light, &shade};
  const bool has_second =
      std::any_of(maps.begin(), maps.end(), [](const auto* map) { return *map && (*map)->contains("texCoord"); });
  if (rough) pbr["metallicRoughnessTexture"] = *rough;
  const char* const unnamed = image ? "the scene's texture" : "the scene's colors";
  Json json{{"name", details.name.empty() ? unnamed : details.name}, {"pbrMetallicRoughness", std::move(pbr)}};
  if (sides == LeafSides::both || (sides == LeafSides::as_material && details.double_sided)) json["doubleSided"] = true;
  if (material.alpha_mode == AlphaMode::mask) {
    json["alphaMode"] = "MASK";
    json["alphaCutoff"] = material.cutoff;
  } else if (material.alpha_mode == AlphaMode::blend) {
    json["alphaMode"] = "BLEND";
  }
  if (normal) {
    json["normalTexture"] = *normal;
    json["normalTexture"]["scale"] = surface.normal_scale;
  }
  if (shade) {
    json["occlusionTexture"] = *shade;
    json["occlusionTexture"]["strength"] = details.occlusion_strength;
  }
  if (light) json["emissiveTexture"] = *light;
  if (surface.emission_factor != std::array<float, 3>{}) json["emissiveFactor"] = surface.emission_factor;
  if (!details.extensions.empty()) {
    json["extensions"] = Json::parse(details.extensions);
    for (const auto& [name, extension] : json["extensions"].items()) data_.use(name, false);
  }
  const bool has_image = image || rough || normal || shade || light;
  return {all_.add_material(std::move(json)), has_second ? std::size_t(2) : has_image ? 1 : 0};
}

/// Returns the reference to an image; none if it is not shown.
std::optional<Json> GlbLeaves::add_map(const TextureMap& map) {
  const auto image = looks_.colors ? image_of(map.image) : std::nullopt;
  if (!image) return {};
  Json json{{"index", all_.add_texture(*image, map.wrap, map.filters)}};
  if (map.in_second_places) json["texCoord"] = 1;
  return json;
}

std::optional<std::size_t> GlbLeaves::image_of(std::uint32_t image) {
  if (image == kNoTextureImage || looks_.images == nullptr || looks_.broken.contains(image)) return {};
  const auto [found, is_new] = images_.try_emplace(image);
  if (!is_new) return found->second;
  if (looks_.name_of) {
    const std::string name = looks_.name_of(image);
    if (!name.empty()) found->second = all_.add_image(name);
  } else if (const std::vector<std::byte> file = looks_.images->file(image); !file.empty()) {
    found->second =
        all_.add_image(std::string(reinterpret_cast<const char*>(file.data()), file.size()), image_type(file));
  }
  return found->second;
}

}  // namespace bp
