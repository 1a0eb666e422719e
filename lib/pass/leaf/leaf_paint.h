#pragma once
#include <map>
#include <string>

#include "lib/core/memory_share.h"
#include "lib/image/mip_image.h"
#include "lib/image/surface_views.h"
#include "lib/pass/leaf/scene_leaf.h"

namespace bp {

/// The images of a scene's materials: small copies of those of colour, and the faults of those that are broken.
class LeafImages {
 public:
  /// Decodes all images that the leaf shows, one after the other. `images`: null: there are none, else it must live as
  /// long. Throws NeedsMemory.
  LeafImages(const SceneLeaf& leaf, const TextureSet* images, const MemoryShare& memory);
  /// Returns the memory that suffices for any leaf with these images.
  [[nodiscard]] static std::uint64_t bytes_needed(const TextureSet& images);

  /// Returns the images that are missing or cannot be decoded, each with the reason.
  [[nodiscard]] const std::map<std::uint32_t, std::string>& broken() const { return broken_; }
  /// Returns null for TriangleTexture::kNoMaterial, and without images.
  [[nodiscard]] const TextureMaterial* material(std::uint32_t i) const;
  /// Returns a copy of at most kSide texels along a side; null if the image is none or broken.
  [[nodiscard]] const MipImage* small(std::uint32_t image) const;

  static constexpr int kSide = 512;

 private:
  const TextureSet* images_;
  std::map<std::uint32_t, MipImage> small_;
  std::map<std::uint32_t, std::string> broken_;
};

/// Returns the base colours of a leaf's triangles, in the order of its parts. Keeps references.
[[nodiscard]] SurfaceViews::ColorAt paint_of(const SceneLeaf& leaf, const LeafImages& images);

}  // namespace bp
