#include "tools/lod/tiles/image_files.h"

#include <algorithm>
#include <span>

#include "io/image/texture_writer.h"
#include "io/mesh/leaf_looks.h"
#include "lib/core/error.h"
#include "lib/store/content_hash.h"
#include "lib/store/hex.h"

namespace bp {

namespace {

/// Memory of an image while it is decoded and made smaller.
constexpr std::uint64_t kBytesPerTexel = 12;

/// Returns the name of an image file of this content and type ("image/png").
std::string hashed_name(std::span<const std::byte> file, const std::string& type) {
  const ResultKey hash = content_hash(file);
  const std::string ending = type == "image/jpeg" ? "jpg" : type.substr(type.find('/') + 1);
  return hex_of(hash.words[0], hash.words[1]) + "." + ending;
}

}  // namespace

ImageFiles::ImageFiles(const TextureSet* images, Scratch& store, const MemoryShare& memory)
    : images_(images), store_(&store), memory_(memory) {}

void ImageFiles::require_memory() const {
  std::uint64_t most = 0;
  for (std::uint32_t i = 0; images_ != nullptr && i < images_->image_count(); ++i) {
    const auto [width, height] = images_->size(i);
    most = std::max(most, kBytesPerTexel * std::uint64_t(width) * std::uint64_t(height));
  }
  if (most > memory_.bytes)
    throw NeedsMemory("an image of the scene", most, memory_.bytes, memory_.limit_for(most), {Remedy::no_textures});
}

std::string ImageFiles::name_of(std::uint32_t image, int halvings, MipImage::Kind kind) {
  Names* names = nullptr;
  {
    const std::lock_guard lock(mutex_);
    std::unique_ptr<Names>& slot = names_[{image, kind}];
    if (slot == nullptr) slot = std::make_unique<Names>();
    names = slot.get();
  }
  std::call_once(names->once, [&] { make(image, kind, *names); });
  if (halvings <= 0 || names->smaller.empty()) return names->own;
  return names->smaller[std::min(std::size_t(halvings), names->smaller.size()) - 1];
}

void ImageFiles::make(std::uint32_t image, MipImage::Kind kind, Names& out) {
  if (images_->size(image)[0] == 0) return;
  if (store_ != nullptr) {
    const std::lock_guard alone(one_at_a_time_);
    try {
      make_smaller(images_->image(image, memory_.bytes), image, kind, out);
    } catch (const Error& e) {
      if (e.code() != ErrorCode::bad_input) throw;
      const std::lock_guard lock(mutex_);
      faults_[image] = e.what();
      return;
    }
  }
  const std::vector<std::byte> file = images_->file(image);
  if (file.empty()) return;
  out.own = hashed_name(file, image_type(file));
  const std::lock_guard lock(mutex_);
  sources_.try_emplace(out.own, Source{image, {}});
}

/// Encodes all smaller images of one: a third of its texels together.
void ImageFiles::make_smaller(TextureImage image, std::uint32_t number, MipImage::Kind kind, Names& out) {
  while (image.width > 1 || image.height > 1) {
    image = halved(image, kind);
    const EncodedImage file = encode_texture(image);
    const auto bytes = std::as_bytes(std::span(file.bytes));
    out.smaller.push_back(hashed_name(bytes, file.type));
    const std::lock_guard lock(mutex_);
    const auto [source, is_new] = sources_.try_emplace(out.smaller.back());
    if (is_new) source->second = {number, store_->put(bytes)};
  }
}

std::string ImageFiles::bytes_of(const std::string& name) const {
  const Source& source = sources_.at(name);
  std::vector<std::byte> bytes;
  if (!source.smaller) return file_text(images_->file(source.image));
  store_->get(*source.smaller, bytes);
  return file_text(bytes);
}

std::vector<std::string> ImageFiles::faults() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> all;
  for (const auto& [image, fault] : faults_) all.push_back(fault);
  return all;
}

}  // namespace bp
