#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lib/core/box.h"
#include "lib/core/memory_share.h"
#include "lib/core/triangle_source.h"
#include "lib/store/result_key.h"
#include "lib/store/scratch.h"

/// The looks of a scene's surface at any place of it: colours of its triangles, and images on them. Out of core.
namespace bp {

class ImageCache;
class LookBlock;
class LookBlocks;
struct TexturedTriangle;

/// Red, green and blue in linear light, from 0 to 1, and how much of the background is covered. Emitted light is
/// included, unless it is asked for separately.
struct Look {
  std::array<float, 3> color{};
  float alpha = 1;
  // Set if asked for:
  std::array<float, 3> normal{};  ///< in the scene, of length 1
  float roughness = 1, metal = 0;
  std::array<float, 3> emission{};  ///< linear light
};

/// The looks of a scene. They depend neither on the order of the triangles nor on the memory.
class SceneLooks {
 public:
  /// The source, and what is known about it: bounds and number of the triangles.
  struct Scene {
    TriangleSource& source;
    Bounds3d bounds;
    std::uint64_t triangles = 0;
    std::shared_ptr<const TextureSet> images;
  };

  /// Reads the source once more, from its start; its triangles wait in `store`. `memory` is for triangles in use, half
  /// of it at most, and for images. Throws NeedsMemory if an image alone is too large.
  SceneLooks(const Scene& scene, std::unique_ptr<Scratch> store, const MemoryShare& memory);
  /// Returns the memory of such looks that each image fits into, beside the triangles in use.
  [[nodiscard]] static std::uint64_t bytes_needed(const TextureSet& images, std::uint64_t triangles);
  ~SceneLooks();
  SceneLooks(const SceneLooks&) = delete;
  SceneLooks& operator=(const SceneLooks&) = delete;

  /// Returns about the smallest texel of the scene's images, scene units, right to a fifth: a tenth of the area that
  /// has images has smaller ones. 0: no image lies on the scene.
  [[nodiscard]] double finest_texel() const { return finest_texel_; }
  /// Adds everything within `box`, images included, and finest_texel().
  void add_to(KeyHash& hash, const Bounds3d& box) const;
  /// Adds the same without finest_texel().
  void add_triangles_to(KeyHash& hash, const Bounds3d& box) const;
  /// Calls f for each triangle whose bounds meet the box, in any order. Thread-safe; one block at a time is in memory.
  void visit(const Bounds3d& box, const std::function<void(const TexturedTriangle&)>& f) const;
  /// Returns the hash of everything that decides how a material of the scene looks; zeros for
  /// TriangleTexture::kNoMaterial.
  [[nodiscard]] ResultKey key_of(std::uint32_t material) const {
    return material == TriangleTexture::kNoMaterial ? ResultKey{} : materials_[material].key;
  }
  /// Returns null if nobody asked for images.
  [[nodiscard]] const TextureSet* images() const { return images_.get(); }
  /// Returns the faults of images that were wanted so far.
  [[nodiscard]] std::vector<std::string> faults() const;

 private:
  friend class SceneEye;
  void read(const Scene& scene, std::uint64_t memory_bytes);
  void note_image(std::uint32_t material);

  std::unique_ptr<LookBlocks> blocks_;
  std::shared_ptr<const TextureSet> images_;
  std::unique_ptr<ImageCache> cache_;
  double finest_texel_ = 0;
  struct Material {
    bool is_known = false;
    std::array<int, 2> size{};  // size of its image with the most texels; 0: it has none
    ResultKey key;              // hash of everything that decides how it looks
  };
  std::vector<Material> materials_;
};

}  // namespace bp
