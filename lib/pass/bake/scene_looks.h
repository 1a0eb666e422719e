#pragma once
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "lib/core/memory_share.h"
#include "lib/core/triangle_source.h"
#include "lib/geometry/triangle_bvh.h"
#include "lib/store/result_key.h"

/// What a scene's surface looks like, at any place of it: colours of its triangles, and images on them.
namespace bp {

class ImageCache;
class MipImage;

/// Red, green and blue in linear light, from 0 to 1, and how much of what is behind is covered.
struct Look {
  std::array<float, 3> color{};
  float alpha = 1;
};

class SceneLooks {
 public:
  /// Bytes of a triangle, while the hierarchy is made.
  static constexpr std::uint64_t kBytesEach = 72 + 18 + 28 + 80 + 2 * 56 + 56;

  /// Reads `source` once more, from its start, in memory as a whole: kBytesEach for each of its `triangles`, and images
  /// in what is left, at least a quarter. Throws NeedsMemory.
  SceneLooks(TriangleSource& source, std::uint64_t triangles, std::shared_ptr<const TextureSet> images,
             const MemoryShare& memory);
  ~SceneLooks();
  SceneLooks(const SceneLooks&) = delete;
  SceneLooks& operator=(const SceneLooks&) = delete;

  [[nodiscard]] const TriangleBvh& triangles() const { return *triangles_; }
  /// Texels of the scene's images are about as small as this, scene units: a tenth of the area that has images has
  /// smaller ones. 0: no image lies on the scene.
  [[nodiscard]] double finest_texel() const { return finest_texel_; }
  /// Everything within `box`, images included.
  void add_to(KeyHash& hash, const Bounds3d& box) const;
  /// What is wrong with images that were wanted so far.
  [[nodiscard]] std::vector<std::string> faults() const;

  /// Looks at places; keeps the images that it had last at hand. Not thread-safe: one for each thread.
  class Eye {
   public:
    explicit Eye(const SceneLooks& looks) : looks_(looks) {}
    /// At `p` on triangle `item` of triangles(), over about `size` scene units along each side.
    [[nodiscard]] Look at(std::uint32_t item, const Vec3d& p, double size);
    /// What that place covers for the sample with this threshold: of holes, all or nothing.
    [[nodiscard]] bool covers(std::uint32_t item, const Vec3d& p, double size, float threshold);

   private:
    struct Held {
      std::uint32_t number = 0;
      std::shared_ptr<const MipImage> image;
    };
    [[nodiscard]] const MipImage* image(std::uint32_t number);
    const SceneLooks& looks_;
    std::vector<Held> held_;  // the latest last
  };

 private:
  void look_over_images();

  std::unique_ptr<TriangleBvh> triangles_;
  std::vector<TriangleColors> colors_;  // by id of triangles_
  std::vector<TriangleTexture> textures_;
  std::shared_ptr<const TextureSet> images_;
  std::unique_ptr<ImageCache> cache_;
  double finest_texel_ = 0;
  std::unordered_map<std::uint32_t, ResultKey> files_;  // hashes of images
};

}  // namespace bp
