#include "lib/image/image_cache.h"

#include "lib/core/error.h"

namespace bp {

std::shared_ptr<const MipImage> ImageCache::get(std::uint32_t image) {
  if (image == TextureMaterial::kNoImage) return nullptr;
  return kept_.get(image, [&] { return decode(image); });
}

std::shared_ptr<const MipImage> ImageCache::decode(std::uint32_t image) {
  try {
    return std::make_shared<const MipImage>(images_->image(image, memory_.bytes / 4 * 3));
  } catch (const NeedsMemory& e) {
    throw Error(e.code(), e.what(), e.remedies(), memory_.limit_with(memory_.bytes));
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
