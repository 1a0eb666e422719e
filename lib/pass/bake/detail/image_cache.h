#pragma once
#include <list>
#include <map>
#include <mutex>
#include <string>
#include <unordered_map>

#include "lib/core/memory_share.h"
#include "lib/pass/bake/detail/mip_image.h"

namespace bp {

/// Images that are decoded when they are first wanted; those that were wanted longest ago make room. Thread-safe.
class ImageCache {
 public:
  /// Images in the cache take at most `memory`; those that someone holds come on top.
  ImageCache(std::shared_ptr<const TextureSet> images, const MemoryShare& memory)
      : images_(std::move(images)), memory_(memory) {}

  /// Null if the image is missing or broken. Throws NeedsMemory if it alone is too large.
  [[nodiscard]] std::shared_ptr<const MipImage> get(std::uint32_t image);
  /// What is wrong with those that are null; in the order of their numbers.
  [[nodiscard]] std::vector<std::string> faults() const;

 private:
  struct Kept {
    std::shared_ptr<const MipImage> image;
    std::list<std::uint32_t>::iterator place;
  };
  [[nodiscard]] std::shared_ptr<const MipImage> decode(std::uint32_t image);
  void make_room();
  std::shared_ptr<const TextureSet> images_;
  MemoryShare memory_;
  mutable std::mutex mutex_;
  std::unordered_map<std::uint32_t, Kept> kept_;
  std::list<std::uint32_t> last_wanted_;  // the latest first
  std::uint64_t bytes_ = 0;
  std::map<std::uint32_t, std::string> faults_;
};

}  // namespace bp
