#include "lib/pass/bake/scene_looks.h"

#include <algorithm>
#include <cmath>

#include "lib/core/error.h"
#include "lib/core/vec3.h"
#include "lib/pass/bake/detail/image_cache.h"

namespace bp {

namespace {

constexpr std::size_t kMostHeld = 4;

/// Texels of an image along a length of 1 on a triangle.
double texels_per_unit(const TriangleD& t, const TriangleTexture& texture, int width, int height) {
  const auto& [a, b, c] = texture.uv;
  const double flat =
      std::abs((double(b[0]) - a[0]) * (double(c[1]) - a[1]) - (double(c[0]) - a[0]) * (double(b[1]) - a[1]));
  const double area = length(cross(t[1] - t[0], t[2] - t[0]));
  const double texels = std::sqrt(flat * width * height / area);
  return std::isfinite(texels) ? texels : 0;
}

}  // namespace

SceneLooks::SceneLooks(TriangleSource& source, std::uint64_t triangles, std::shared_ptr<const TextureSet> images,
                       const MemoryShare& memory)
    : images_(std::move(images)) {
  const std::uint64_t needed = triangles * kBytesEach, room = memory.bytes / 4 * 3;
  if (needed > room)
    throw NeedsMemory(fmt::format("baking textures from {} triangles", triangles), needed, room,
                      memory.limit_with((needed - room) / 3 * 4), {Remedy::no_textures});
  std::vector<TriangleD> all, chunk;
  std::vector<TriangleColors> colors;
  std::vector<TriangleTexture> textures;
  all.reserve(triangles);
  colors_.reserve(triangles);
  textures_.reserve(triangles);
  source.rewind();
  while (all.size() <= triangles && source.read_textured(chunk, colors, textures)) {
    all.insert(all.end(), chunk.begin(), chunk.end());
    colors_.insert(colors_.end(), colors.begin(), colors.end());
    textures_.insert(textures_.end(), textures.begin(), textures.end());
  }
  if (all.size() != triangles)
    fail(ErrorCode::bad_input, "{}: has changed while it was at work; run it again", source.name());
  triangles_ = std::make_unique<TriangleBvh>(all);
  MemoryShare rest = memory;
  rest.bytes -= needed;
  cache_ = std::make_unique<ImageCache>(images_, rest);
  look_over_images();
}

void SceneLooks::look_over_images() {
  struct Part {
    float texel, area;
  };
  std::vector<Part> parts;
  std::unordered_map<std::uint32_t, std::array<int, 2>> sizes;
  double total = 0;
  for (std::size_t i = 0; i < triangles_->size(); ++i) {
    const auto& [t, id] = triangles_->item(i);
    const TriangleTexture& texture = textures_[id];
    if (texture.material == TriangleTexture::kNoMaterial) continue;
    const std::uint32_t image = images_->material(texture.material).image;
    if (image == TextureMaterial::kNoImage) continue;
    if (!sizes.contains(image)) {
      sizes[image] = images_->size(image);
      ContentHash hash;
      hash.add(images_->file(image));
      files_[image] = hash.value();
    }
    const auto [width, height] = sizes[image];
    const double texels = texels_per_unit(t, texture, width, height);
    if (!(texels > 0)) continue;
    const double area = length(cross(t[1] - t[0], t[2] - t[0]));
    parts.push_back({float(1 / texels), float(area)});
    total += parts.back().area;
  }
  std::sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.texel < b.texel; });
  double area = 0;
  for (const Part& p : parts) {
    finest_texel_ = p.texel;
    if ((area += p.area) >= total / 10) break;
  }
}

void SceneLooks::add_to(KeyHash& hash, const Bounds3d& box) const {
  std::vector<const TriangleBvh::Item*> items;
  triangles_->visit(box, [&](const TriangleBvh::Item& item) {
    items.push_back(&item);
    return false;
  });
  std::sort(items.begin(), items.end(), [](const auto* a, const auto* b) { return a->id < b->id; });
  for (const TriangleBvh::Item* const item : items) {
    hash.add(item->corners, colors_[item->id]);
    const TriangleTexture& texture = textures_[item->id];
    if (texture.material == TriangleTexture::kNoMaterial) continue;
    const TextureMaterial& m = images_->material(texture.material);
    for (const auto& [u, v] : texture.uv) hash.add(double(u), double(v));
    hash.add(m.wrap, m.alpha_mode, double(m.alpha), double(m.cutoff), m.replaces_color);
    if (const auto found = files_.find(m.image); found != files_.end()) hash.add(found->second);
  }
}

SceneLooks::~SceneLooks() = default;

std::vector<std::string> SceneLooks::faults() const {
  return cache_->faults();
}

const MipImage* SceneLooks::Eye::image(std::uint32_t number) {
  const auto found = std::find_if(held_.begin(), held_.end(), [&](const Held& h) { return h.number == number; });
  if (found != held_.end()) return found->image.get();
  if (held_.size() == kMostHeld) held_.erase(held_.begin());
  held_.push_back({number, looks_.cache_->get(number)});
  return held_.back().image.get();
}

Look SceneLooks::Eye::at(std::uint32_t item, const Vec3d& p, double size) {
  const auto& [corners, id] = looks_.triangles_->item(item);
  std::array<double, 3> part = barycentric(corners, p);
  for (double& x : part) x = std::clamp(x, 0.0, 1.0);
  Look look;
  const TriangleColors& colors = looks_.colors_[id];
  const auto mean = [&](std::uint16_t LinearColor::*c) {
    return float((part[0] * colors[0].*c + part[1] * colors[1].*c + part[2] * colors[2].*c) / 65535);
  };
  look.color = {mean(&LinearColor::r), mean(&LinearColor::g), mean(&LinearColor::b)};
  const TriangleTexture& texture = looks_.textures_[id];
  if (texture.material == TriangleTexture::kNoMaterial) return look;
  const TextureMaterial& material = looks_.images_->material(texture.material);
  const MipImage* const seen = image(material.image);
  if (seen == nullptr) return look;
  std::array<double, 2> uv{};
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < 2; ++i) uv[i] += part[k] * double(texture.uv[k][i]);
  }
  const LinearTexel texel =
      seen->at(uv[0], uv[1], size * texels_per_unit(corners, texture, seen->width(), seen->height()), material.wrap);
  for (std::size_t i = 0; i < 3; ++i) look.color[i] = material.replaces_color ? texel[i] : look.color[i] * texel[i];
  if (material.alpha_mode != AlphaMode::opaque) look.alpha = std::clamp(texel[3] * material.alpha, 0.0F, 1.0F);
  return look;
}

bool SceneLooks::Eye::covers(std::uint32_t item, const Vec3d& p, double size, float threshold) {
  const TriangleTexture& texture = looks_.textures_[looks_.triangles_->item(item).id];
  if (texture.material == TriangleTexture::kNoMaterial) return true;
  const TextureMaterial& material = looks_.images_->material(texture.material);
  if (material.alpha_mode == AlphaMode::opaque) return true;
  return at(item, p, size).alpha >= (material.alpha_mode == AlphaMode::mask ? material.cutoff : threshold);
}

}  // namespace bp
