#include "lib/pass/bake/detail/image_cache.h"

#include "lib/core/error.h"

namespace bp {

std::shared_ptr<const MipImage> ImageCache::get(std::uint32_t image) {
  const std::lock_guard lock(mutex_);
  if (const auto found = kept_.find(image); found != kept_.end()) {
    last_wanted_.splice(last_wanted_.begin(), last_wanted_, found->second.place);
    return found->second.image;
  }
  if (image == TextureMaterial::kNoImage || faults_.contains(image)) return nullptr;
  std::shared_ptr<const MipImage> decoded = decode(image);
  if (!decoded) return nullptr;
  last_wanted_.push_front(image);
  kept_[image] = {decoded, last_wanted_.begin()};
  bytes_ += decoded->bytes();
  make_room();
  return decoded;
}

std::shared_ptr<const MipImage> ImageCache::decode(std::uint32_t image) {
  try {
    return std::make_shared<const MipImage>(images_->image(image, memory_.bytes / 4 * 3));
  } catch (const NeedsMemory& e) {
    throw Error(e.code(), e.what(), e.remedies(), memory_.limit_with(memory_.bytes));
  } catch (const Error& e) {
    if (e.code() != ErrorCode::bad_input) throw;
    faults_[image] = e.what();
    return nullptr;
  }
}

void ImageCache::make_room() {
  while (bytes_ > memory_.bytes && last_wanted_.size() > 1) {
    const auto oldest = kept_.find(last_wanted_.back());
    bytes_ -= oldest->second.image->bytes();
    kept_.erase(oldest);
    last_wanted_.pop_back();
  }
}

std::vector<std::string> ImageCache::faults() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> all;
  for (const auto& [image, fault] : faults_) all.push_back(fault);
  return all;
}

}  // namespace bp
