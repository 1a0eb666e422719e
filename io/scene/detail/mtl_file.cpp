#include "io/scene/detail/mtl_file.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>

#include "io/files/beside.h"
#include "io/files/utf8.h"
#include "io/scene/detail/text/text_scanner.h"
#include "lib/core/error.h"

namespace bp {

namespace {

/// Returns the folder part of a path; empty, or with a slash at its end.
std::string folder_before(const std::string& path) {
  return path.substr(0, path.rfind('/') + 1);
}

/// Returns the bytes of a string outside the string object, with those that the allocator adds.
std::uint64_t heap_bytes(const std::string& text) {
  static const std::size_t inside = std::string().capacity();
  return text.capacity() > inside ? text.capacity() + 2 * sizeof(void*) : 0;
}

/// Returns the share, or as much of it as is `most` of the rest of its limit.
MemoryShare at_most(MemoryShare memory, double most) {
  const double part = memory.share > 0 ? std::min(1.0, most / memory.share) : most;
  memory.bytes = std::uint64_t(double(memory.bytes) * part);
  memory.share *= part;
  memory.least_share = std::min(memory.least_share, most);
  return memory;
}

std::uint32_t hash_of(const std::string& name) {
  return std::uint32_t(std::hash<std::string>()(name));
}

/// Clamps to [0, 1]; NaN becomes 0.
double clamped(double x) {
  return std::min(1.0, std::max(0.0, x));
}

}  // namespace

MtlMaterials::MtlMaterials(const MemoryShare& document)
    : is_limited_(document.bytes > 0), memory_(at_most(document, kMostShare)) {}

void MtlMaterials::load(const std::string& beside, const std::string& name) {
  if (beside.empty() || name.empty()) return;
  try {
    const std::string path = find_beside(folder_before(beside), name);
    const auto [found, is_new] = file_numbers_.try_emplace(path, std::uint32_t(files_.size()));
    if (is_new) files_.push_back({&found->first, 0});
    File& file = files_[found->second];
    if (file.loaded != loads_ || is_new) kept_.clear(), kept_bytes_ = 0, file.loaded = ++loads_;
    if (!is_new) return;
    if (fit()) too_many_ = path;
    list(path, found->second);
  } catch (const Error&) {
    return;
  }
}

void MtlMaterials::refuse() const {
  throw NeedsMemory(fmt::format("{}: the list of materials", too_many_), bytes(), memory_.bytes,
                    memory_.limit_for(bytes()));
}

void MtlMaterials::clear() {
  file_numbers_.clear(), files_.clear();
  places_.clear(), kept_.clear();
  loads_ = count_ = kept_bytes_ = 0;
  open_.reset();
}

/// Lists the materials of a file. If the file is broken further on, those before count.
void MtlMaterials::list(const std::string& path, std::uint32_t file) {
  TextScanner text(open_scene_file(path, "", NamedBy::file));
  std::string name;
  std::optional<std::uint64_t> begin;
  const auto add_last = [&] {
    if (begin) add(name, file, *begin, text.offset());
    begin.reset();
  };
  try {
    for (; !text.at_end(); text.next_line()) {
      if (!text.word_on_line() || text.peek() != 'n') continue;
      const std::uint64_t here = text.offset();
      if (text.word() != "newmtl") continue;
      if (begin) add(name, file, *begin, here);
      begin.reset();
      if (count_ == kMost) return;
      name = text.rest_of_line();
      begin = here;
    }
  } catch (const Error&) {
    return add_last();
  }
  add_last();
}

/// Adds the place of a material. Once the places do not fit, it only counts them.
void MtlMaterials::add(const std::string& name, std::uint32_t file, std::uint64_t begin, std::uint64_t end) {
  constexpr std::uint64_t kMostLength = (1ULL << Place::kLengthBits) - 1, kMostOffset = ~0ULL >> Place::kLengthBits;
  if (begin > kMostOffset) return;
  ++count_;
  if (!fit()) return;
  const std::uint64_t length = std::min(end - begin, kMostLength);
  places_.push_back({hash_of(name), file, begin << Place::kLengthBits | length});
  sorted_ = false;
}

/// Returns the material of this name; null if there is none. Valid until the next call.
MtlMaterials::Material* MtlMaterials::find_to_change(const std::string& name) {
  // with the tree's links, and bytes that the allocator adds
  constexpr std::uint64_t kNodeBytes = sizeof(decltype(kept_)::value_type) + 6 * sizeof(void*);
  auto found = kept_.find(name);
  if (found == kept_.end()) {
    if (kept_bytes_ > kMostKept) kept_.clear(), kept_bytes_ = 0;
    found = kept_.emplace(name, read(name)).first;
    kept_bytes_ += kNodeBytes + heap_bytes(name) + found->second.heap_bytes();
  }
  return found->second.file == nullptr ? nullptr : &found->second;
}

/// Reads the material of this name: of several, the last one of the file that was loaded last.
MtlMaterials::Material MtlMaterials::read(const std::string& name) {
  const auto by_hash = [](const Place& a, const Place& b) { return a.hash < b.hash; };
  if (!sorted_) std::sort(places_.begin(), places_.end(), by_hash);
  sorted_ = true;
  const auto [first, last] = std::equal_range(places_.begin(), places_.end(), Place{hash_of(name), 0, 0}, by_hash);
  std::vector<Place> candidates(first, last);
  std::sort(candidates.begin(), candidates.end(), [&](const Place& a, const Place& b) {
    return std::make_tuple(files_[a.file].loaded, a.at()) > std::make_tuple(files_[b.file].loaded, b.at());
  });
  Material material;
  for (const Place& place : candidates)
    if (read_at(place, name, material)) return material;
  return {};
}

/// Reads the material at a place. Returns false if it has another name. Lines that cannot be read are left out.
bool MtlMaterials::read_at(const Place& place, const std::string& name, Material& material) {
  try {
    if (!open_ || open_number_ != place.file)
      open_ = open_scene_file(*files_[place.file].path, "", NamedBy::file), open_number_ = place.file;
    TextScanner text(part_of(open_, place.at(), place.length()));
    if (!text.word_on_line() || text.word() != "newmtl" || text.rest_of_line() != name) return false;
    material.file = files_[place.file].path;
    for (text.next_line(); !text.at_end(); text.next_line())
      if (text.word_on_line()) read_line(text, std::string(text.word()), material);
  } catch (const Error&) {
    return material.file != nullptr;
  }
  return true;
}

void MtlMaterials::read_line(TextScanner& text, const std::string& key, Material& material) {
  const auto numbers = [&](auto& all) {
    bool there = true;
    for (double& x : all) there = there && text.word_on_line() && text.real(x);
    return there;
  };
  std::array<double, 3> rgb{};
  std::array<double, 1> x{};
  if (key == "Kd") {
    if (numbers(rgb)) material.color = color_from_srgb(rgb);
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
    using Member = Map Maps::*;
    static const std::map<std::string, Member> members{
        {"map_Kd", &Maps::color}, {"norm", &Maps::normal},      {"map_Bump", &Maps::bump}, {"map_bump", &Maps::bump},
        {"bump", &Maps::bump},    {"map_Pr", &Maps::roughness}, {"map_Pm", &Maps::metal},  {"map_Ke", &Maps::emission}};
    const auto found = members.find(key);
    if (found == members.end()) return;
    if (material.own_maps == nullptr) material.own_maps = std::make_unique<Maps>();
    read_map(text, (*material.own_maps).*(found->second));
  }
}

/// Largest strength of -bm: more than images are wide. Slopes beyond it are cliffs anyway.
constexpr double kMostStrength = 65536;

// Reads "map_Kd -s 2 2 1 -clamp on some name.png": options have words or numbers after them, and the name may have
// blanks.
void MtlMaterials::read_map(TextScanner& text, Map& map) {
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

std::string MtlMaterials::path_of(const Map& map, const Material& material) {
  return find_beside(folder_before(*material.file), map.image);
}

const MtlMaterials::Maps& MtlMaterials::Material::maps() const {
  static const Maps none;
  return own_maps ? *own_maps : none;
}

const MtlMaterials::Map& MtlMaterials::Material::first_map() const {
  for (const Map* map : maps().all())
    if (!map->image.empty()) return *map;
  return maps().color;
}

std::uint64_t MtlMaterials::Material::heap_bytes() const {
  if (own_maps == nullptr) return 0;
  std::uint64_t sum = sizeof(Maps) + 2 * sizeof(void*);
  for (const Map* map : own_maps->all()) sum += bp::heap_bytes(map->image);
  return sum;
}

/// Returns an image of a material; none, with a fault, if it is missing or if its coordinates differ from those of the
/// material's first image.
TextureMap MtlMaterials::map_of(const Map& map, const Material& material, TextureTable& textures,
                                const std::optional<Relief>& relief) {
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

void MtlMaterials::add_light(const Material& material, TextureTable& textures, TextureSurface& s) {
  s.emission_factor = {float(material.emission.r) / 65535, float(material.emission.g) / 65535,
                       float(material.emission.b) / 65535};
  s.emission = map_of(material.maps().emission, material, textures);
  if (s.emission.is_there()) s.emission_factor = {1, 1, 1};
}

/// Returns the surface of a material. Roughness and metal come from one image (TextureSurface): two would have to be
/// mixed.
TextureSurface MtlMaterials::surface_of(const Material& material, TextureTable& textures) {
  TextureSurface s;
  s.roughness_factor = float(material.roughness);
  s.metal_factor = float(material.metal);
  add_light(material, textures, s);
  const Map &directions = material.maps().normal, &bump = material.maps().bump;
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

std::uint32_t MtlMaterials::texture(const std::string& material, TextureTable& textures, bool surface, bool details) {
  Material* const found = find_to_change(material);
  if (found == nullptr) return TriangleTexture::kNoMaterial;
  Material& m = *found;
  if (m.number) return *m.number;
  TextureMaterial t;
  if (surface) t.surface = surface_of(m, textures);
  if (!surface && m.has_image()) add_light(m, textures, t.surface);
  if (details) t.details.name = as_utf8(material);
  if (m.maps().color.image.empty() && t.surface == TextureSurface{} && !details) {
    m.number = TriangleTexture::kNoMaterial;
    return *m.number;
  }
  const Map& map = m.maps().color;
  const std::string path = map.image.empty() ? "" : path_of(map, m);
  if (!path.empty()) t.image = textures.add_image(path, {path, nullptr, path});
  t.replaces_color = !path.empty();
  t.alpha = float(m.alpha);
  t.alpha_mode = m.see_through ? AlphaMode::blend : AlphaMode::opaque;
  if (map.clamp) t.wrap = {TextureWrap::clamp, TextureWrap::clamp};
  std::string key = fmt::format("{} {} {} {}", path, map.clamp, m.see_through, m.alpha);
  if (details || t.surface != TextureSurface{}) key += fmt::format(" {} {}", *m.file, material);
  m.number = textures.add_material(key, t);
  return *m.number;
}

bool MtlMaterials::has_image(const std::string& material) {
  const Material* const found = find(material);
  return found != nullptr && found->has_image();
}

std::array<float, 2> MtlMaterials::place(const std::string& material, double u, double v) {
  const Material* const found = find(material);
  if (found == nullptr) return {};
  const std::array<double, 4>& by = found->first_map().uv;
  return {float(by[0] * u + by[1]), float(1 - (by[2] * v + by[3]))};
}

LinearColor MtlMaterials::color(const std::string& material, bool surface) {
  const Material* const found = find(material);
  if (found == nullptr) return kWhite;
  const Material& m = *found;
  if (surface || m.has_image()) return m.color;
  const auto sum = [](std::uint16_t a, std::uint16_t b) { return std::uint16_t(std::min(65535, int(a) + int(b))); };
  return {sum(m.color.r, m.emission.r), sum(m.color.g, m.emission.g), sum(m.color.b, m.emission.b)};
}

bool MtlMaterials::see_through(const std::string& material) {
  const Material* const found = find(material);
  return found != nullptr && found->see_through;
}

}  // namespace bp
