#include "lib/image/image_cache.h"

#include <algorithm>
#include <array>

#include "lib/core/error.h"

namespace bp {

namespace {

std::uint64_t decoded_bytes(const TextureSet& images, std::uint32_t i) {
  const std::array<int, 2> size = images.size(i);
  return std::uint64_t(size[0]) * std::uint64_t(size[1]) * sizeof(TextureImage::Texel);
}

}  // namespace

std::uint64_t ImageCache::bytes_needed(const TextureSet& images, std::uint64_t image_bytes) {
  for (std::uint32_t i = 0; i < images.image_count(); ++i)
    image_bytes = std::max(image_bytes, decoded_bytes(images, i));
  return image_bytes / 3 * 4 + 8;
}

std::shared_ptr<const MipImage> ImageCache::get(std::uint32_t image, MipImage::Kind kind) {
  if (image == TextureMaterial::kNoImage) return nullptr;
  return kept_.get(2 * image + std::uint32_t(kind), [&] { return decode(image, kind); });
}

/// An image that is being decoded. It waits until the others at work leave room for it.
class ImageCache::AtWork {
 public:
  AtWork(ImageCache& cache, std::uint64_t bytes) : cache_(cache), bytes_(bytes) {
    std::unique_lock lock(cache_.work_mutex_);
    std::uint64_t& sum = cache_.at_work_bytes_;
    cache_.less_work_.wait(lock, [&] { return sum == 0 || sum + bytes_ <= cache_.memory_.bytes; });
    sum += bytes_;
  }
  ~AtWork() {
    {
      const std::lock_guard lock(cache_.work_mutex_);
      cache_.at_work_bytes_ -= bytes_;
    }
    cache_.less_work_.notify_all();
  }
  AtWork(const AtWork&) = delete;
  AtWork& operator=(const AtWork&) = delete;

 private:
  ImageCache& cache_;
  const std::uint64_t bytes_;
};

std::shared_ptr<const MipImage> ImageCache::decode(std::uint32_t image, MipImage::Kind kind) {
  const AtWork at_work(*this, decoded_bytes(*images_, image));
  try {
    return std::make_shared<const MipImage>(images_->image(image, memory_.bytes / 4 * 3), kind);
  } catch (const NeedsMemory& e) {
    throw Error(e.code(), e.what(), e.remedies(), memory_.limit_for(bytes_needed(*images_, e.needed_bytes())));
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
