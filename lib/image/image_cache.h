#pragma once
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "lib/core/lru_cache.h"
#include "lib/core/memory_share.h"
#include "lib/image/mip_image.h"

namespace bp {

/// Decodes images when they are first wanted. Thread-safe.
class ImageCache {
 public:
  /// Holds images of a scene that was read; null: it has none. Images in the cache take at most `memory`. Images that
  /// left it and are held by someone come on top.
  ImageCache(std::shared_ptr<const TextureSet> images, const MemoryShare& memory)
      : images_(std::move(images)),
        memory_(memory),
        kept_(memory.bytes, images_ == nullptr ? 0 : 2 * images_->image_count()) {}

  [[nodiscard]] const TextureMaterial& material(std::uint32_t i) const { return images_->material(i); }
  /// Returns null if the image is missing or broken. Throws NeedsMemory if it alone is too large.
  [[nodiscard]] std::shared_ptr<const MipImage> get(std::uint32_t image, MipImage::Kind kind = MipImage::Kind::color);
  /// Returns the faults of the images that are null, in the order of their numbers.
  [[nodiscard]] std::vector<std::string> faults() const;

 private:
  [[nodiscard]] std::uint64_t share_for(std::uint64_t image_bytes) const;
  [[nodiscard]] std::shared_ptr<const MipImage> decode(std::uint32_t image, MipImage::Kind kind);
  std::shared_ptr<const TextureSet> images_;
  MemoryShare memory_;
  LruCache<MipImage> kept_;
  mutable std::mutex mutex_;
  std::map<std::uint32_t, std::string> faults_;
};

}  // namespace bp
