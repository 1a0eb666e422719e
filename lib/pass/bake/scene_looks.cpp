#include "lib/pass/bake/scene_looks.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "lib/core/error.h"
#include "lib/core/vec3.h"
#include "lib/image/image_cache.h"
#include "lib/pass/bake/detail/look_blocks.h"
#include "lib/pass/bake/detail/triangle_sorter.h"
#include "lib/pass/bake/textured_triangle.h"
#include "lib/store/content_hash.h"
#include "lib/store/packing.h"

namespace bp {

namespace {

/// Sums areas by the size of the texels on them.
class TexelSizes {
 public:
  void add(double texel, double area) {
    areas_[bin_of(float(texel))] += area;
    total_ += area;
  }
  /// Returns the size below which a tenth of the area has its texels, a bin more or less; 0 if there is none.
  [[nodiscard]] double tenth() const {
    double area = 0;
    for (std::size_t bin = 0; bin < areas_.size(); ++bin) {
      area += areas_[bin];
      if (area > 0 && area >= total_ * (0.1 - 1e-9))  // rounding must not decide
        return std::bit_cast<float>(std::uint32_t(bin) << kShift);
    }
    return 0;
  }

 private:
  static constexpr int kShift = 21;  // the sign, the exponent, and four steps for each
  static std::size_t bin_of(float x) { return std::bit_cast<std::uint32_t>(x) >> kShift; }
  std::vector<double> areas_ = std::vector<double>(std::size_t(1) << (31 - kShift));
  double total_ = 0;
};

void pack_map(std::string& all, const TextureMap& map, const TextureSet& images) {
  pack(all, map.wrap[0]);
  pack(all, map.wrap[1]);
  pack(all, map.is_there());
  if (!map.is_there()) return;
  for (const std::uint64_t word : content_hash(images.file(map.image)).words) pack(all, word);
  if (!map.in_second_places && map.filters == TextureFilters{}) return;
  pack(all, map.in_second_places);
  for (const std::uint16_t filter : map.filters) pack(all, filter);
}

void pack_surface(std::string& all, const TextureSurface& surface, const TextureSet& images) {
  for (const TextureMap* map : {&surface.normal, &surface.roughness, &surface.emission}) pack_map(all, *map, images);
  for (const float x : {surface.normal_scale, surface.roughness_factor, surface.metal_factor}) pack(all, x);
  for (const float x : surface.emission_factor) pack(all, x);
}

void pack_details(std::string& all, const TextureMaterial& material, const TextureSet& images) {
  const MaterialDetails& details = material.details;
  pack(all, details.name);
  pack(all, details.extensions);
  pack(all, details.double_sided);
  pack_map(all, details.occlusion, images);
  pack(all, details.occlusion_strength);
  for (const std::uint16_t filter : material.filters) pack(all, filter);
}

}  // namespace

SceneLooks::SceneLooks(const Scene& scene, std::unique_ptr<Scratch> store, const MemoryShare& memory)
    : blocks_(std::make_unique<LookBlocks>(std::move(store))), images_(scene.images) {
  read(scene, memory.bytes);
  const double part = std::min(0.5, double(scene.triangles * LookBlocks::kBytesEach) / double(memory.bytes));
  MemoryShare rest = memory;
  rest.bytes = std::uint64_t(double(memory.bytes) * (1 - part));
  rest.share *= 1 - part;
  blocks_->close(memory.bytes - rest.bytes);
  cache_ = std::make_unique<ImageCache>(images_, rest);
}

std::uint64_t SceneLooks::bytes_needed(const TextureSet& images, std::uint64_t triangles) {
  const std::uint64_t image = ImageCache::bytes_needed(images);
  return std::min(2 * image, image + triangles * LookBlocks::kBytesEach);  // triangles get half of it at most
}

SceneLooks::~SceneLooks() = default;

void SceneLooks::read(const Scene& scene, std::uint64_t memory_bytes) {
  TriangleSorter sorter(scene.bounds, blocks_->store(), memory_bytes / 2);
  TexelSizes sizes;
  std::vector<TriangleD> triangles;
  std::vector<TriangleColors> colors;
  std::vector<TriangleTexture> textures;
  std::uint64_t count = 0;
  scene.source.rewind();
  while (count <= scene.triangles && scene.source.read_textured(triangles, colors, textures)) {
    count += triangles.size();
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const TriangleD& t = triangles[i];
      sorter.add({t, colors[i], textures[i]});
      if (textures[i].material == TriangleTexture::kNoMaterial) continue;
      note_image(textures[i].material);
      const double texels = texels_per_unit(t, textures[i], materials_[textures[i].material].size);
      if (texels > 0) sizes.add(1 / texels, length(cross(t[1] - t[0], t[2] - t[0])));
    }
  }
  if (count != scene.triangles)
    fail(ErrorCode::bad_input, "{}: has changed while it was at work; run it again", scene.source.name());
  sorter.finish(LookBlocks::kTriangles, [&](std::span<const TexturedTriangle> block) { blocks_->add(block); });
  finest_texel_ = sizes.tenth();
}

void SceneLooks::note_image(std::uint32_t material) {
  if (materials_.size() <= material) materials_.resize(material + 1);
  Material& noted = materials_[material];
  if (noted.is_known) return;
  noted.is_known = true;
  const TextureMaterial& m = images_->material(material);
  std::string all;  // it is not a KeyHash, since it decides between surfaces at one place, in every version
  pack(all, m.wrap[0]);
  pack(all, m.wrap[1]);
  pack(all, m.alpha_mode);
  pack(all, m.alpha);
  pack(all, m.cutoff);
  pack(all, m.replaces_color);
  if (m.surface != TextureSurface{}) pack_surface(all, m.surface, *images_);
  if (m.details != MaterialDetails{} || m.filters != TextureFilters{}) pack_details(all, m, *images_);
  for (const std::uint32_t image : m.images()) {
    if (image == TextureMaterial::kNoImage) continue;
    const std::array<int, 2> size = images_->size(image);
    if (std::int64_t(size[0]) * size[1] > std::int64_t(noted.size[0]) * noted.size[1]) noted.size = size;
  }
  if (m.image != TextureMaterial::kNoImage) {
    for (const std::uint64_t word : content_hash(images_->file(m.image)).words) pack(all, word);
  }
  noted.key = content_hash(std::as_bytes(std::span(all)));
}

void SceneLooks::visit(const Bounds3d& box, const std::function<void(const TexturedTriangle&)>& f) const {
  blocks_->visit(box, [&](std::uint32_t block) {
    for (const TexturedTriangle& t : blocks_->load(block)) {
      if (overlap(bounds_of(t.corners), box)) f(t);
    }
  });
}

/// Adds a sum of the hashes of triangles. It does not depend on their order, and takes little memory.
void SceneLooks::add_triangles_to(KeyHash& hash, const Bounds3d& box) const {
  std::array<std::uint64_t, 2> sum{};
  std::uint64_t count = 0;
  ContentHash one;
  visit(box, [&](const TexturedTriangle& t) {
    one.reset();
    one.add(std::as_bytes(std::span(t.corners)));
    one.add(std::as_bytes(std::span(t.colors)));
    if (t.texture.material != TriangleTexture::kNoMaterial) {
      one.add(std::as_bytes(std::span(t.texture.uv)));
      if (t.texture.second_uv != decltype(t.texture.second_uv){})
        one.add(std::as_bytes(std::span(t.texture.second_uv)));
      one.add(std::as_bytes(std::span(materials_[t.texture.material].key.words)));
    }
    if (t.texture.normals != decltype(t.texture.normals){}) one.add(std::as_bytes(std::span(t.texture.normals)));
    for (std::size_t i = 0; i < 2; ++i) sum[i] += one.value().words[i];
    ++count;
  });
  hash.add(count, sum);
}

void SceneLooks::add_to(KeyHash& hash, const Bounds3d& box) const {
  add_triangles_to(hash, box);
  hash.add(finest_texel_);
}

std::vector<std::string> SceneLooks::faults() const {
  return cache_->faults();
}

}  // namespace bp
