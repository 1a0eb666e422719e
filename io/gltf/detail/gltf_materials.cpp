#include "io/gltf/detail/gltf_materials.h"

#include <algorithm>
#include <cmath>

#include "io/gltf/gltf_sampler.h"

// glTF 2.0, section 3.9, and KHR_materials_pbrSpecularGlossiness, which came before it.

namespace bp {

namespace {

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

/// Returns the first image of a material without an image of colours. Its coordinates count for all images of the
/// material.
std::optional<GltfObject> first_map(const GltfObject& material) {
  for (const char* const name : {"normalTexture", "emissiveTexture"}) {
    if (material.has(name)) return material.object(name);
  }
  if (!material.has("pbrMetallicRoughness")) return {};
  const GltfObject pbr = material.object("pbrMetallicRoughness");
  if (!pbr.has("metallicRoughnessTexture")) return {};
  return pbr.object("metallicRoughnessTexture");
}

}  // namespace

// Adds the image that multiplies the colours (section 3.9.2), that of light (section 3.9.3), and, if surfaces are asked
// for, the other properties of the material.
void GltfMaterials::add_texture(std::uint64_t i, const GltfObject& attributes, Primitive& primitive) {
  const GltfObject material = doc_.root().item("materials", i);
  const std::optional<GltfObject> base = base_texture(material);
  if (!base && !surface_ && !has_light_image(material)) return;
  if (const std::optional<GltfObject> places = base ? base : first_other(material))
    add_places(*places, attributes, primitive);
  if (!primitive.uv && !surface_) return;
  primitive.material = texture_material(i, material, primitive.uv ? base : std::nullopt);
  primitive.has_image = primitive.uv && (base || textures_->material(primitive.material).surface.emission.is_there());
}

std::optional<GltfObject> GltfMaterials::first_other(const GltfObject& material) const {
  if (surface_) return first_map(material);
  return material.object("emissiveTexture");
}

/// Adds the coordinates of images, with KHR_texture_transform.
void GltfMaterials::add_places(const GltfObject& info, const GltfObject& attributes, Primitive& primitive) {
  std::uint64_t set = info.number("texCoord", 0);
  if (info.has_extension("KHR_texture_transform")) {
    const GltfObject moved = info.object("extensions").object("KHR_texture_transform");
    const auto offset = moved.numbers<2>("offset", {0, 0}), scale = moved.numbers<2>("scale", {1, 1});
    const double turn = moved.has("rotation") ? moved.real("rotation") : 0, c = std::cos(turn), s = std::sin(turn);
    primitive.uv_transform = {c * scale[0], s * scale[1], offset[0], -s * scale[0], c * scale[1], offset[1]};
    set = moved.number("texCoord", set);
  }
  const std::string name = fmt::format("TEXCOORD_{}", set);
  if (!attributes.has(name.c_str())) return;
  primitive.uv = doc_.accessor(attributes.number(name.c_str()), 2);
  if (primitive.uv->count != primitive.positions.count)
    attributes.broken(
        fmt::format("have {} places in images for {} positions", primitive.uv->count, primitive.positions.count));
}

std::optional<GltfObject> GltfMaterials::base_texture(const GltfObject& material) const {
  constexpr const char* kOlder = "KHR_materials_pbrSpecularGlossiness";
  if (material.has_extension(kOlder)) {
    const GltfObject older = material.object("extensions").object(kOlder);
    if (older.has("diffuseTexture")) return older.object("diffuseTexture");
  }
  if (!material.has("pbrMetallicRoughness")) return {};
  const GltfObject pbr = material.object("pbrMetallicRoughness");
  if (!pbr.has("baseColorTexture")) return {};
  return pbr.object("baseColorTexture");
}

std::array<TextureWrap, 2> GltfMaterials::wrap_of(const GltfObject& texture) const {
  const auto wrap = [&](const char* key) {
    if (!texture.has("sampler")) return TextureWrap::repeat;
    return wrap_of_gltf(doc_.root().item("samplers", texture.number("sampler")).number(key, 0));
  };
  return {wrap("wrapS"), wrap("wrapT")};
}

std::uint32_t GltfMaterials::texture_material(std::uint64_t i, const GltfObject& material,
                                              const std::optional<GltfObject>& base) {
  TextureMaterial m;
  if (base) {
    const GltfObject texture = doc_.root().item("textures", base->number("index"));
    m.image = image_of(texture);
    m.wrap = wrap_of(texture);
  }
  const std::string mode = material.has("alphaMode") ? material.text("alphaMode") : "OPAQUE";
  m.alpha_mode = mode == "MASK" ? AlphaMode::mask : mode == "BLEND" ? AlphaMode::blend : AlphaMode::opaque;
  m.alpha = float(base_color(i)[3]);
  if (material.has("alphaCutoff")) m.cutoff = float(material.real("alphaCutoff"));
  if (surface_) m.surface = surface_of(material, base ? base : first_map(material));
  if (!surface_) add_light(material, base, m.surface);
  return textures_->add_material(fmt::format("{}: materials[{}]{}", file_, i, base ? "" : " alone"), m);
}

// Returns the surface of a material (sections 3.9.2 and 3.9.3). `places`: the image whose coordinates count for all
// images.
TextureSurface GltfMaterials::surface_of(const GltfObject& material, const std::optional<GltfObject>& places) {
  TextureSurface s;
  s.metal_factor = 1;
  if (material.has("pbrMetallicRoughness")) {
    const GltfObject pbr = material.object("pbrMetallicRoughness");
    if (pbr.has("roughnessFactor")) s.roughness_factor = float(pbr.real("roughnessFactor"));
    if (pbr.has("metallicFactor")) s.metal_factor = float(pbr.real("metallicFactor"));
    if (pbr.has("metallicRoughnessTexture")) s.roughness = map_of(pbr.object("metallicRoughnessTexture"), places);
  } else if (material.has_extension("KHR_materials_pbrSpecularGlossiness")) {
    s.metal_factor = 0;
  }
  add_light(material, places, s);
  if (!material.has("normalTexture")) return s;
  const GltfObject normal = material.object("normalTexture");
  s.normal = map_of(normal, places);
  if (normal.has("scale")) s.normal_scale = float(normal.real("scale"));
  return s;
}

void GltfMaterials::add_light(const GltfObject& material, const std::optional<GltfObject>& places, TextureSurface& s) {
  s.emission_factor = light_of(material);
  if (has_light_image(material)) s.emission = map_of(material.object("emissiveTexture"), places);
}

/// Returns an image of a material; none, with a fault, if its coordinates differ from those of the image of colours.
TextureMap GltfMaterials::map_of(const GltfObject& info, const std::optional<GltfObject>& places) {
  if (places && !same_places(info, *places)) {
    textures_->add_fault(
        fmt::format("{}: an image lies at other places than its material's first one; it is left out", file_));
    return {};
  }
  const GltfObject texture = doc_.root().item("textures", info.number("index"));
  return {image_of(texture), wrap_of(texture)};
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
  constexpr const char* kOlder = "KHR_materials_pbrSpecularGlossiness";
  if (material.has_extension(kOlder))
    rgba = material.object("extensions").object(kOlder).numbers<4>("diffuseFactor", rgba);
  if (surface_ || base_texture(material) || has_light_image(material)) return rgba;
  const std::array<float, 3> light = light_of(material);
  for (std::size_t k = 0; k < 3; ++k) rgba[k] = std::min(1.0, rgba[k] + double(light[k]));
  return rgba;
}

// Returns whether a material can be seen through: masks have holes, and blended materials show what is behind. The
// alpha of an opaque material is ignored.
bool GltfMaterials::see_through(std::uint64_t i) const {
  const GltfObject material = doc_.root().item("materials", i);
  return (material.has("alphaMode") && material.text("alphaMode") != "OPAQUE") || base_color(i)[3] < 1;
}

}  // namespace bp
