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

/// Returns the name of an image file of this content and type ("image/png").
std::string hashed_name(std::span<const std::byte> file, const std::string& type) {
  const ResultKey hash = content_hash(file);
  const std::string ending = type == "image/jpeg" ? "jpg" : type.substr(type.find('/') + 1);
  return hex_of(hash.words[0], hash.words[1]) + "." + ending;
}

}  // namespace

/// The names of an image's smaller files: halved once, twice, ...; empty: the image is broken.
struct ImageFiles::Smaller {
  std::once_flag once;
  std::vector<std::string> names;
};

ImageFiles::ImageFiles(const TextureSet* images, Scratch* store, std::uint64_t most_bytes)
    : images_(images), store_(store), most_bytes_(most_bytes) {}

ImageFiles::~ImageFiles() = default;

std::string ImageFiles::own_name(std::uint32_t image) {
  const std::lock_guard lock(mutex_);
  const auto [found, is_new] = own_.try_emplace(image);
  if (is_new && images_->size(image)[0] > 0) {
    const std::vector<std::byte> file = images_->file(image);
    if (file.empty()) return found->second;
    found->second = hashed_name(file, image_type(file));
    sources_.try_emplace(found->second, Source{image, {}});
  }
  return found->second;
}

std::string ImageFiles::name_of(std::uint32_t image, int halvings, MipImage::Kind kind) {
  if (halvings <= 0) return own_name(image);
  Smaller* smaller = nullptr;
  {
    const std::lock_guard lock(mutex_);
    std::unique_ptr<Smaller>& slot = smaller_[{image, kind}];
    if (slot == nullptr) slot = std::make_unique<Smaller>();
    smaller = slot.get();
  }
  std::call_once(smaller->once, [&] { make_smaller(image, kind, *smaller); });
  if (smaller->names.empty()) return "";
  return smaller->names[std::min(std::size_t(halvings), smaller->names.size()) - 1];
}

/// Encodes all smaller images of one: a third of its texels together.
void ImageFiles::make_smaller(std::uint32_t image, MipImage::Kind kind, Smaller& out) {
  const std::lock_guard alone(one_at_a_time_);
  try {
    TextureImage last = images_->image(image, most_bytes_);
    do {
      last = halved(last, kind);
      const EncodedImage file = encode_texture(last);
      const auto bytes = std::as_bytes(std::span(file.bytes));
      out.names.push_back(hashed_name(bytes, file.type));
      const std::lock_guard lock(mutex_);
      const auto [source, is_new] = sources_.try_emplace(out.names.back());
      if (is_new) source->second = {image, store_->put(bytes)};
    } while (last.width > 1 || last.height > 1);
  } catch (const Error& e) {
    if (e.code() != ErrorCode::bad_input) throw;
    const std::lock_guard lock(mutex_);
    faults_[image] = e.what();
    out.names.clear();
  }
}

std::string ImageFiles::bytes_of(const std::string& name) const {
  const Source& source = sources_.at(name);
  std::vector<std::byte> bytes;
  if (source.smaller) {
    store_->get(*source.smaller, bytes);
  } else {
    bytes = images_->file(source.image);
  }
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::vector<std::string> ImageFiles::faults() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> all;
  for (const auto& [image, fault] : faults_) all.push_back(fault);
  return all;
}

}  // namespace bp
