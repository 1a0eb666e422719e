#include "io/gltf/detail/gltf_materials.h"

#include <algorithm>
#include <cmath>

#include "io/gltf/gltf_sampler.h"

// glTF 2.0, section 3.9, and KHR_materials_pbrSpecularGlossiness, which came before it.

namespace bp {

namespace {

constexpr const char* kOlderMaterial = "KHR_materials_pbrSpecularGlossiness";

/// Returns whether two images use the same coordinates on a mesh.
bool same_places(const GltfObject& a, const GltfObject& b) {
  const auto transform = [](const GltfObject& info) -> std::string {
    constexpr const char* kName = "KHR_texture_transform";
    if (!info.has_extension(kName)) return "";
    return info.object("extensions").object(kName).dump();
  };
  return a.number("texCoord", 0) == b.number("texCoord", 0) && transform(a) == transform(b);
}

std::array<float, 3> light_of(const GltfObject& material) {
  const auto light = material.numbers<3>("emissiveFactor", {0, 0, 0});
  return {float(light[0]), float(light[1]), float(light[2])};
}

bool has_light_image(const GltfObject& material) {
  return material.has("emissiveTexture") && light_of(material) != std::array<float, 3>{};
}

/// Returns the images of a material other than that of colours.
std::vector<GltfObject> other_maps(const GltfObject& material) {
  std::vector<GltfObject> maps;
  for (const char* const name : {"normalTexture", "emissiveTexture"}) {
    if (material.has(name)) maps.push_back(material.object(name));
  }
  if (material.has("pbrMetallicRoughness")) {
    const GltfObject pbr = material.object("pbrMetallicRoughness");
    if (pbr.has("metallicRoughnessTexture")) maps.push_back(pbr.object("metallicRoughnessTexture"));
  }
  return maps;
}

/// Returns the material's extensions that name no image, as text. Adds the names of the others to `left_out`.
std::string extensions_of(const GltfObject& material, std::vector<std::string>& left_out) {
  if (!material.has("extensions")) return "";
  GltfJson kept = GltfJson::object();
  for (const auto& [name, extension] : material.object("extensions").json().items()) {
    // The older kind of material became a newer one.
    if (!name.starts_with("KHR_materials_") || name == kOlderMaterial) continue;
    if (extension.dump().find("Texture\"") == std::string::npos) {
      kept[name] = extension;
    } else {
      left_out.push_back(name);
    }
  }
  return kept.empty() ? "" : kept.dump();
}

}  // namespace

// Adds the image that multiplies the colours (section 3.9.2), that of light (section 3.9.3), and, if surfaces are asked
// for, the other properties of the material.
void GltfMaterials::add_texture(std::uint64_t i, const GltfObject& attributes, Primitive& primitive) {
  const GltfObject material = doc_.root().item("materials", i);
  const std::optional<GltfObject> base = base_texture(material);
  if (!base && !surface_ && !has_light_image(material)) return;
  const Leaders leaders = leaders_of(material, base);
  if (leaders.first) primitive.uv = places_of(*leaders.first, attributes, primitive, primitive.uv_transform);
  if (leaders.second && primitive.uv)
    primitive.second_uv = places_of(*leaders.second, attributes, primitive, primitive.second_uv_transform);
  if (!primitive.uv && !surface_) return;
  primitive.material = texture_material(i, material, primitive.uv ? base : std::nullopt, leaders);
  primitive.has_image = primitive.uv && (base || textures_->material(primitive.material).surface.emission.is_there());
  if (details_) add_spare_places(leaders, attributes, primitive);
}

/// Finds the images whose coordinates count: the image of colours, else another one; and, for details, the first one
/// that lies elsewhere.
GltfMaterials::Leaders GltfMaterials::leaders_of(const GltfObject& material,
                                                 const std::optional<GltfObject>& base) const {
  Leaders leaders{base, {}};
  if (!surface_) {
    if (!base) leaders.first = material.object("emissiveTexture");
    return leaders;
  }
  std::vector<GltfObject> others = other_maps(material);
  if (details_ && material.has("occlusionTexture")) others.push_back(material.object("occlusionTexture"));
  for (const GltfObject& map : others) {
    if (!leaders.first) leaders.first = map;
    if (details_ && !leaders.second && !same_places(map, *leaders.first)) leaders.second = map;
  }
  return leaders;
}

/// Returns the coordinates of an image, and their KHR_texture_transform; none if the mesh has none.
std::optional<Accessor> GltfMaterials::places_of(const GltfObject& info, const GltfObject& attributes,
                                                 const Primitive& primitive, std::array<double, 6>& transform) {
  std::uint64_t set = info.number("texCoord", 0);
  if (info.has_extension("KHR_texture_transform")) {
    const GltfObject moved = info.object("extensions").object("KHR_texture_transform");
    const auto offset = moved.numbers<2>("offset", {0, 0}), scale = moved.numbers<2>("scale", {1, 1});
    const double turn = moved.has("rotation") ? moved.real("rotation") : 0, c = std::cos(turn), s = std::sin(turn);
    transform = {c * scale[0], s * scale[1], offset[0], -s * scale[0], c * scale[1], offset[1]};
    set = moved.number("texCoord", set);
  }
  return set_of_places(set, attributes, primitive);
}

std::optional<Accessor> GltfMaterials::set_of_places(std::uint64_t set, const GltfObject& attributes,
                                                     const Primitive& primitive) {
  const std::string name = fmt::format("TEXCOORD_{}", set);
  if (!attributes.has(name.c_str())) return {};
  Accessor places = doc_.accessor(attributes.number(name.c_str()), 2);
  if (places.count != primitive.positions.count)
    attributes.broken(
        fmt::format("have {} places in images for {} positions", places.count, primitive.positions.count));
  return places;
}

/// Adds coordinates that no image uses: those of baked light, or for an image that an engine adds.
void GltfMaterials::add_spare_places(const Leaders& leaders, const GltfObject& attributes, Primitive& primitive) {
  if (!primitive.uv) primitive.uv = set_of_places(0, attributes, primitive);
  if (!primitive.uv || primitive.second_uv) return;
  const bool first_is_second = leaders.first && leaders.first->number("texCoord", 0) == 1;
  primitive.second_uv = set_of_places(first_is_second ? 0 : 1, attributes, primitive);
}

std::optional<GltfObject> GltfMaterials::base_texture(const GltfObject& material) const {
  if (material.has_extension(kOlderMaterial)) {
    const GltfObject older = material.object("extensions").object(kOlderMaterial);
    if (older.has("diffuseTexture")) return older.object("diffuseTexture");
  }
  if (!material.has("pbrMetallicRoughness")) return {};
  const GltfObject pbr = material.object("pbrMetallicRoughness");
  if (!pbr.has("baseColorTexture")) return {};
  return pbr.object("baseColorTexture");
}

/// Returns a texture as an image, with its sampler.
TextureMap GltfMaterials::texture_of(const GltfObject& info) {
  const GltfObject texture = doc_.root().item("textures", info.number("index"));
  TextureMap map;
  map.image = image_of(texture);
  if (!texture.has("sampler")) return map;
  const GltfObject sampler = doc_.root().item("samplers", texture.number("sampler"));
  map.wrap = {wrap_of_gltf(sampler.number("wrapS", 0)), wrap_of_gltf(sampler.number("wrapT", 0))};
  if (details_)
    map.filters = {filter_of_gltf(sampler.number("minFilter", 0)), filter_of_gltf(sampler.number("magFilter", 0))};
  return map;
}

std::uint32_t GltfMaterials::texture_material(std::uint64_t i, const GltfObject& material,
                                              const std::optional<GltfObject>& base, const Leaders& leaders) {
  TextureMaterial m;
  if (base) {
    const TextureMap map = texture_of(*base);
    m.image = map.image;
    m.wrap = map.wrap;
    m.filters = map.filters;
  }
  const std::string mode = material.has("alphaMode") ? material.text("alphaMode") : "OPAQUE";
  m.alpha_mode = mode == "MASK" ? AlphaMode::mask : mode == "BLEND" ? AlphaMode::blend : AlphaMode::opaque;
  m.alpha = float(base_color(i)[3]);
  if (material.has("alphaCutoff")) m.cutoff = float(material.real("alphaCutoff"));
  if (surface_) m.surface = surface_of(material, leaders);
  if (!surface_) add_light(material, leaders, m.surface);
  if (details_) m.details = details_of(material, leaders);
  return textures_->add_material(fmt::format("{}: materials[{}]{}", file_, i, base ? "" : " alone"), m);
}

// Returns the surface of a material (sections 3.9.2 and 3.9.3).
TextureSurface GltfMaterials::surface_of(const GltfObject& material, const Leaders& leaders) {
  TextureSurface s;
  s.metal_factor = 1;
  if (material.has("pbrMetallicRoughness")) {
    const GltfObject pbr = material.object("pbrMetallicRoughness");
    if (pbr.has("roughnessFactor")) s.roughness_factor = float(pbr.real("roughnessFactor"));
    if (pbr.has("metallicFactor")) s.metal_factor = float(pbr.real("metallicFactor"));
    if (pbr.has("metallicRoughnessTexture")) s.roughness = map_of(pbr.object("metallicRoughnessTexture"), leaders);
  } else if (material.has_extension(kOlderMaterial)) {
    s.metal_factor = 0;
  }
  add_light(material, leaders, s);
  if (!material.has("normalTexture")) return s;
  const GltfObject normal = material.object("normalTexture");
  s.normal = map_of(normal, leaders);
  if (normal.has("scale")) s.normal_scale = float(normal.real("scale"));
  return s;
}

MaterialDetails GltfMaterials::details_of(const GltfObject& material, const Leaders& leaders) {
  MaterialDetails details;
  if (material.has("name")) details.name = material.text("name");
  details.double_sided = material.flag("doubleSided");
  if (material.has("occlusionTexture")) {
    const GltfObject occlusion = material.object("occlusionTexture");
    details.occlusion = map_of(occlusion, leaders);
    if (occlusion.has("strength")) details.occlusion_strength = float(occlusion.real("strength"));
  }
  std::vector<std::string> left_out;
  details.extensions = extensions_of(material, left_out);
  for (const std::string& name : left_out)
    textures_->add_fault(fmt::format("{}: {} of a material names images; it is left out", file_, name));
  return details;
}

void GltfMaterials::add_light(const GltfObject& material, const Leaders& leaders, TextureSurface& s) {
  s.emission_factor = light_of(material);
  if (has_light_image(material)) s.emission = map_of(material.object("emissiveTexture"), leaders);
}

/// Returns an image of a material; none, with a fault, if no leader has its coordinates.
TextureMap GltfMaterials::map_of(const GltfObject& info, const Leaders& leaders) {
  const bool is_first = !leaders.first || same_places(info, *leaders.first);
  if (!is_first && !(leaders.second && same_places(info, *leaders.second))) {
    textures_->add_fault(
        fmt::format("{}: an image lies at other places than its material's first one; it is left out", file_));
    return {};
  }
  TextureMap map = texture_of(info);
  map.in_second_places = !is_first;
  return map;
}

std::uint32_t GltfMaterials::image_of(const GltfObject& texture) {
  std::optional<std::uint64_t> source;
  if (texture.has("source")) source = texture.number("source");
  if (texture.has_extension("EXT_texture_webp"))
    source = texture.object("extensions").object("EXT_texture_webp").number("source");
  for (const char* const unread : {"KHR_texture_basisu", "MSFT_texture_dds", "EXT_texture_avif"}) {
    if (source || !texture.has_extension(unread)) continue;  // the reader of images tells why it cannot be shown
    source = texture.object("extensions").object(unread).number("source");
  }
  if (!source) return TextureMaterial::kNoImage;
  return textures_->add_image(fmt::format("{}: images[{}]", file_, *source), doc_.image(*source));
}

std::array<double, 4> GltfMaterials::base_color(std::uint64_t i) const {
  const GltfObject material = doc_.root().item("materials", i);
  std::array<double, 4> rgba{1, 1, 1, 1};
  if (material.has("pbrMetallicRoughness"))
    rgba = material.object("pbrMetallicRoughness").numbers<4>("baseColorFactor", rgba);
  if (material.has_extension(kOlderMaterial))
    rgba = material.object("extensions").object(kOlderMaterial).numbers<4>("diffuseFactor", rgba);
  if (surface_ || base_texture(material) || has_light_image(material)) return rgba;
  const std::array<float, 3> light = light_of(material);
  for (std::size_t k = 0; k < 3; ++k) rgba[k] = std::min(1.0, rgba[k] + double(light[k]));
  return rgba;
}

bool transmits_light(const GltfObject& material) {
  constexpr const char* kName = "KHR_materials_transmission";
  if (!material.has_extension(kName)) return false;
  const GltfObject glass = material.object("extensions").object(kName);
  return glass.has("transmissionFactor") && glass.real("transmissionFactor") > 0;
}

// Returns whether a material can be seen through: masks have holes, and blended materials and glass show what is
// behind. The alpha of an opaque material is ignored by viewers, but tells what its author meant.
bool GltfMaterials::see_through(std::uint64_t i) const {
  const GltfObject material = doc_.root().item("materials", i);
  return (material.has("alphaMode") && material.text("alphaMode") != "OPAQUE") || base_color(i)[3] < 1 ||
         transmits_light(material);
}

}  // namespace bp
