#include "io/scene/detail/obj/mtl_material.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "io/files/beside.h"
#include "io/files/utf8.h"
#include "lib/core/error.h"

namespace bp {

std::string folder_before(const std::string& path) {
  return path.substr(0, path.rfind('/') + 1);
}

std::uint64_t heap_bytes(const std::string& text) {
  static const std::size_t inside = std::string().capacity();
  return text.capacity() > inside ? text.capacity() + 2 * sizeof(void*) : 0;
}

const MtlMaps& MtlMaterial::maps() const {
  static const MtlMaps none;
  return own_maps ? *own_maps : none;
}

const MtlMap& MtlMaterial::first_map() const {
  for (const MtlMap* map : maps().all())
    if (!map->image.empty()) return *map;
  return maps().color;
}

std::uint64_t MtlMaterial::heap_bytes() const {
  if (own_maps == nullptr) return 0;
  std::uint64_t sum = sizeof(MtlMaps) + 2 * sizeof(void*);
  for (const MtlMap* map : own_maps->all()) sum += bp::heap_bytes(map->image);
  return sum;
}

std::array<float, 2> MtlMaterial::place(double u, double v) const {
  const std::array<double, 4>& by = first_map().uv;
  return {float(by[0] * u + by[1]), float(1 - (by[2] * v + by[3]))};
}

LinearColor MtlMaterial::color(bool surface) const {
  if (surface || has_image()) return diffuse;
  const auto sum = [](std::uint16_t a, std::uint16_t b) { return std::uint16_t(std::min(65535, int(a) + int(b))); };
  return {sum(diffuse.r, emission.r), sum(diffuse.g, emission.g), sum(diffuse.b, emission.b)};
}

namespace {

/// Clamps to [0, 1]; NaN becomes 0.
double clamped(double x) {
  return std::min(1.0, std::max(0.0, x));
}

/// Largest strength of -bm: more than images are wide. Slopes beyond it are cliffs anyway.
constexpr double kMostStrength = 65536;

// Reads "map_Kd -s 2 2 1 -clamp on some name.png": options have words or numbers after them, and the name may have
// blanks.
void read_mtl_map(TextScanner& text, MtlMap& map) {
  while (text.word_on_line() && text.peek() == '-') {
    const std::string option(text.word());
    if (option == "-s" || option == "-o" || option == "-t") {
      std::array<double, 3> numbers = option == "-s" ? std::array<double, 3>{1, 1, 1} : std::array<double, 3>{};
      for (double& x : numbers) {
        if (!text.word_on_line() || !text.real(x)) break;
      }
      if (option == "-t") continue;
      const std::size_t at = option == "-s" ? 0 : 1;
      map.uv[at] = numbers[0];
      map.uv[at + 2] = numbers[1];
    } else if (option == "-bm") {
      double strength = 1;
      if (text.word_on_line() && text.real(strength) && std::isfinite(strength))
        map.strength = std::clamp(strength, -kMostStrength, kMostStrength);
    } else {
      const std::string value = text.word_on_line() ? std::string(text.word()) : "";
      if (option == "-clamp") map.clamp = value == "on";
      if (option == "-mm" && text.word_on_line()) (void)text.word();
    }
  }
  map.image = text.word_on_line() ? text.rest_of_line() : "";
}

std::string path_of(const MtlMap& map, const MtlMaterial& material) {
  return find_beside(folder_before(*material.file), map.image);
}

/// Returns an image of a material; none, with a fault, if it is missing or if its coordinates differ from those of the
/// material's first image.
TextureMap map_of(const MtlMap& map, const MtlMaterial& material, TextureTable& textures,
                  const std::optional<Relief>& relief = {}) {
  if (map.image.empty()) return {};
  const std::string path = path_of(map, material);
  if (map.uv != material.first_map().uv) {
    textures.add_fault(fmt::format("{}: lies at other places than its material's first image; it is left out", path));
    return {};
  }
  const std::string kind = relief ? fmt::format("relief {} {} ", relief->strength, relief->repeats) : "";
  const std::uint32_t image = textures.add_image(kind + path, {path, nullptr, path, relief});
  const std::array<int, 2> size = textures.size(image);
  if (size[0] == 0) {
    textures.add_fault(textures.fault_of(image) + "; it is left out");
    return {};
  }
  if (relief && std::uint64_t(size[0]) * std::uint64_t(size[1]) > kMostRelief) {
    textures.add_fault(
        fmt::format("{}: map_Bump has more than 4096 x 4096 texels, and is left out; norm may have more", path));
    return {};
  }
  const TextureWrap wrap = map.clamp ? TextureWrap::clamp : TextureWrap::repeat;
  return {image, {wrap, wrap}};
}

void add_light(const MtlMaterial& material, TextureTable& textures, TextureSurface& s) {
  s.emission_factor = {float(material.emission.r) / 65535, float(material.emission.g) / 65535,
                       float(material.emission.b) / 65535};
  s.emission = map_of(material.maps().emission, material, textures);
  if (s.emission.is_there()) s.emission_factor = {1, 1, 1};
}

/// Returns the surface of a material. Roughness and metal come from one image (TextureSurface): two would have to be
/// mixed.
TextureSurface surface_of(const MtlMaterial& material, TextureTable& textures) {
  TextureSurface s;
  s.roughness_factor = float(material.roughness);
  s.metal_factor = float(material.metal);
  add_light(material, textures, s);
  const MtlMap &directions = material.maps().normal, &bump = material.maps().bump;
  if (directions.image.empty()) {
    s.normal = map_of(bump, material, textures, Relief{bump.strength, !bump.clamp});
  } else {
    s.normal = map_of(directions, material, textures);
    if (s.normal.is_there()) s.normal_scale = float(directions.strength);
  }
  const bool both = material.maps().roughness == material.maps().metal;
  if (both || (material.maps().metal.image.empty() && material.metal == 0)) {
    s.roughness = map_of(material.maps().roughness, material, textures);
    if (s.roughness.is_there()) s.roughness_factor = 1;
    if (s.roughness.is_there() && both) s.metal_factor = 1;
  } else if (!material.maps().roughness.image.empty() || !material.maps().metal.image.empty()) {
    textures.add_fault(fmt::format(
        "{}: roughness and metal come from one image for both, or from map_Pr where Pm is 0; numbers are used",
        *material.file));
  }
  return s;
}

}  // namespace

void read_mtl_line(TextScanner& text, const std::string& key, MtlMaterial& material) {
  const auto numbers = [&](auto& all) {
    bool there = true;
    for (double& x : all) there = there && text.word_on_line() && text.real(x);
    return there;
  };
  std::array<double, 3> rgb{};
  std::array<double, 1> x{};
  if (key == "Kd") {
    if (numbers(rgb)) material.diffuse = color_from_srgb(rgb);
  } else if (key == "Ke") {
    if (numbers(rgb)) material.emission = color_from_srgb(rgb);
  } else if (key == "Pr") {
    if (numbers(x)) material.roughness = clamped(x[0]);
  } else if (key == "Pm") {
    if (numbers(x)) material.metal = clamped(x[0]);
  } else if (key == "d" || key == "Tr") {
    if (!numbers(x) || !(x[0] < 1 && (key == "d" || x[0] > 0))) return;
    material.see_through = true;
    material.alpha = key == "d" ? x[0] : 1 - x[0];
  } else if (key == "map_d") {
    material.see_through = true;
  } else {
    using Member = MtlMap MtlMaps::*;
    static const std::map<std::string, Member> members{{"map_Kd", &MtlMaps::color},  {"norm", &MtlMaps::normal},
                                                       {"map_Bump", &MtlMaps::bump}, {"map_bump", &MtlMaps::bump},
                                                       {"bump", &MtlMaps::bump},     {"map_Pr", &MtlMaps::roughness},
                                                       {"map_Pm", &MtlMaps::metal},  {"map_Ke", &MtlMaps::emission}};
    const auto found = members.find(key);
    if (found == members.end()) return;
    if (material.own_maps == nullptr) material.own_maps = std::make_unique<MtlMaps>();
    read_mtl_map(text, (*material.own_maps).*(found->second));
  }
}

std::uint32_t texture_of(MtlMaterial& material, const std::string& name, TextureTable& textures, bool surface,
                         bool details) {
  if (material.number) return *material.number;
  TextureMaterial t;
  if (surface) t.surface = surface_of(material, textures);
  if (!surface && material.has_image()) add_light(material, textures, t.surface);
  if (details) t.details.name = as_utf8(name);
  if (material.maps().color.image.empty() && t.surface == TextureSurface{} && !details) {
    material.number = TriangleTexture::kNoMaterial;
    return *material.number;
  }
  const MtlMap& map = material.maps().color;
  const std::string path = map.image.empty() ? "" : path_of(map, material);
  if (!path.empty()) t.image = textures.add_image(path, {path, nullptr, path});
  t.replaces_color = !path.empty();
  t.alpha = float(material.alpha);
  t.alpha_mode = material.see_through ? AlphaMode::blend : AlphaMode::opaque;
  if (map.clamp) t.wrap = {TextureWrap::clamp, TextureWrap::clamp};
  std::string key = fmt::format("{} {} {} {}", path, map.clamp, material.see_through, material.alpha);
  if (details || t.surface != TextureSurface{}) key += fmt::format(" {} {}", *material.file, name);
  material.number = textures.add_material(key, t);
  return *material.number;
}

}  // namespace bp
