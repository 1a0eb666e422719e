#include "lib/image/image_cache.h"

#include <algorithm>
#include <array>

#include "lib/core/error.h"

namespace bp {

/// Returns the share of the memory at which an image of so many bytes fits, as well as each other image.
std::uint64_t ImageCache::share_for(std::uint64_t image_bytes) const {
  for (std::uint32_t i = 0; i < images_->image_count(); ++i) {
    const std::array<int, 2> size = images_->size(i);
    image_bytes = std::max(image_bytes, std::uint64_t(size[0]) * std::uint64_t(size[1]) * sizeof(TextureImage::Texel));
  }
  return image_bytes / 3 * 4 + 8;
}

std::shared_ptr<const MipImage> ImageCache::get(std::uint32_t image, MipImage::Kind kind) {
  if (image == TextureMaterial::kNoImage) return nullptr;
  return kept_.get(2 * image + std::uint32_t(kind), [&] { return decode(image, kind); });
}

std::shared_ptr<const MipImage> ImageCache::decode(std::uint32_t image, MipImage::Kind kind) {
  try {
    return std::make_shared<const MipImage>(images_->image(image, memory_.bytes / 4 * 3), kind);
  } catch (const NeedsMemory& e) {
    throw Error(e.code(), e.what(), e.remedies(), memory_.limit_for(share_for(e.needed_bytes())));
  } catch (const Error& e) {
    if (e.code() != ErrorCode::bad_input) throw;
    const std::lock_guard lock(mutex_);
    faults_[image] = e.what();
    return nullptr;
  }
}

std::vector<std::string> ImageCache::faults() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> all;
  for (const auto& [image, fault] : faults_) all.push_back(fault);
  return all;
}

}  // namespace bp
