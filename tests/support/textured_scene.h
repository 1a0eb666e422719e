#pragma once
#include <map>
#include <memory>

#include "lib/core/error.h"
#include "lib/geometry/triangle_bvh.h"
#include "lib/pass/bake/scene_looks.h"
#include "lib/store/memory_scratch.h"
#include "tests/support/memory_scene.h"

/// Scenes with images, in memory.
namespace bp::test {

class MemoryTextures final : public TextureSet {
 public:
  std::vector<TextureImage> images;  ///< one without texels is broken
  std::vector<TextureMaterial> materials;
  mutable int decoded = 0;

  [[nodiscard]] const TextureMaterial& material(std::uint32_t i) const override { return materials.at(i); }
  [[nodiscard]] std::uint32_t image_count() const override { return std::uint32_t(images.size()); }
  [[nodiscard]] std::array<int, 2> size(std::uint32_t i) const override {
    return {images.at(i).width, images.at(i).height};
  }
  [[nodiscard]] std::vector<std::byte> file(std::uint32_t i) const override {
    const auto bytes = std::as_bytes(std::span(images.at(i).texels));
    return {bytes.begin(), bytes.end()};
  }
  [[nodiscard]] TextureImage image(std::uint32_t i, std::uint64_t most_bytes) const override {
    ++decoded;
    const TextureImage& found = images.at(i);
    if (found.texels.empty()) fail(ErrorCode::bad_input, "image {}: broken", i);
    if (found.texels.size() * 4 > most_bytes) throw NeedsMemory("the image", found.texels.size() * 4, most_bytes, 0);
    return found;
  }
};

struct TexturedScene {
  Triangles triangles;
  std::vector<TriangleTexture> textures;
  TriangleColors color{};  ///< of all

  /// A parallelogram; u runs along `u`, v along `v`, over the image's part from `lo` to `hi`.
  void add(const Vec3d& corner, const Vec3d& u, const Vec3d& v, std::uint32_t material,
           std::array<float, 2> lo = {0, 0}, std::array<float, 2> hi = {1, 1}) {
    const auto at = [&](double a, double b) {
      Vec3d p;
      for (std::size_t i = 0; i < 3; ++i) p[i] = corner[i] + a * u[i] + b * v[i];
      return p;
    };
    triangles.push_back({at(0, 0), at(1, 0), at(1, 1)});
    textures.push_back({{lo, {hi[0], lo[1]}, hi}, material});
    triangles.push_back({at(0, 0), at(1, 1), at(0, 1)});
    textures.push_back({{lo, hi, {lo[0], hi[1]}}, material});
  }
  /// The six sides of a cube, each with a sixth of the image beside the others.
  void add_cube(const Vec3d& corner, double edge, std::uint32_t material) {
    for (std::size_t side = 0; side < 6; ++side) {
      const std::size_t k = side % 3;
      Vec3d from = corner, u{}, v{};
      u[(k + 1) % 3] = edge;
      v[(k + 2) % 3] = edge;
      if (side >= 3) {
        from[k] += edge;
      } else {
        std::swap(u, v);
      }
      add(from, u, v, material, {float(side) / 6, 0}, {float(side + 1) / 6, 1});
    }
  }
};

class TexturedSource final : public TriangleSource {
 public:
  explicit TexturedSource(TexturedScene scene) : scene_(std::move(scene)), plain_(scene_.triangles, 5) {}
  bool read(std::vector<TriangleD>& out) override { return plain_.read(out); }
  bool read_textured(std::vector<TriangleD>& out, std::vector<TriangleColors>& colors,
                     std::vector<TriangleTexture>& textures) override {
    const auto first = std::ptrdiff_t(plain_.counts().triangles);
    const bool more = plain_.read(out);
    colors.assign(out.size(), scene_.color);
    textures.assign(scene_.textures.begin() + first, scene_.textures.begin() + first + std::ptrdiff_t(out.size()));
    return more;
  }
  [[nodiscard]] bool has_textures() const override { return true; }
  void rewind() override { plain_.rewind(); }
  [[nodiscard]] const SceneCounts& counts() const override { return plain_.counts(); }
  [[nodiscard]] std::string name() const override { return "memory"; }

 private:
  TexturedScene scene_;
  MemorySource plain_;
};

/// Returns the looks of a scene, which is read once.
inline std::unique_ptr<SceneLooks> looks_of(const TexturedScene& scene,
                                            const std::shared_ptr<const TextureSet>& textures,
                                            const MemoryShare& memory = {}) {
  TexturedSource source(scene);
  const SceneLooks::Scene read{source, bounds_of(scene.triangles), scene.triangles.size(), textures};
  return std::make_unique<SceneLooks>(read, std::make_unique<MemoryScratch>(), memory);
}

/// Returns a set with one material, number 0, whose image is brown.
inline std::shared_ptr<MemoryTextures> one_material() {
  auto textures = std::make_shared<MemoryTextures>();
  textures->images.emplace_back(4, 4, TextureImage::Texel{200, 100, 50, 255});
  textures->materials.push_back({});
  textures->materials.back().image = 0;
  return textures;
}

}  // namespace bp::test
