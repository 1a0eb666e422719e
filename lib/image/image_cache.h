#pragma once
#include <condition_variable>
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
  /// Holds images of a scene that was read; null: it has none. Images in the cache take at most `memory`, and so do
  /// images that are being decoded. Images that left it and are held by someone come on top.
  ImageCache(std::shared_ptr<const TextureSet> images, const MemoryShare& memory)
      : images_(std::move(images)),
        memory_(memory),
        kept_(memory.bytes, images_ == nullptr ? 0 : 2 * images_->image_count()) {}

  /// Returns the memory of a cache at which each of these images fits, and one of `image_bytes`.
  [[nodiscard]] static std::uint64_t bytes_needed(const TextureSet& images, std::uint64_t image_bytes = 0);
  [[nodiscard]] const TextureMaterial& material(std::uint32_t i) const { return images_->material(i); }
  /// Returns null if the image is missing or broken. Throws NeedsMemory if it alone is too large.
  [[nodiscard]] std::shared_ptr<const MipImage> get(std::uint32_t image, MipImage::Kind kind = MipImage::Kind::color);
  /// Returns the faults of the images that are null, in the order of their numbers.
  [[nodiscard]] std::vector<std::string> faults() const;

 private:
  class AtWork;
  [[nodiscard]] std::shared_ptr<const MipImage> decode(std::uint32_t image, MipImage::Kind kind);
  std::shared_ptr<const TextureSet> images_;
  MemoryShare memory_;
  LruCache<MipImage> kept_;
  std::mutex work_mutex_;
  std::condition_variable less_work_;
  std::uint64_t at_work_bytes_ = 0;  // images that are being decoded
  mutable std::mutex mutex_;         // for faults_
  std::map<std::uint32_t, std::string> faults_;
};

}  // namespace bp
