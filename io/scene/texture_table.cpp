#include "io/scene/texture_table.h"

#include <algorithm>
#include <cstring>
#include <filesystem>

#include "io/files/file.h"
#include "io/files/kept_files.h"
#include "io/image/image_reader.h"
#include "io/image/texture_writer.h"
#include "lib/core/error.h"

namespace bp {

namespace {

constexpr std::uint64_t kMostBytes = std::uint64_t(512) << 20;  // of an encoded image
constexpr std::uint64_t kMostHead = std::uint64_t(1) << 20;     // of its beginning, which has its size

template <class T>
std::uint32_t number_of(const std::string& key, const T& value, std::map<std::string, std::uint32_t>& numbers,
                        std::vector<T>& values) {
  const auto [found, is_new] = numbers.try_emplace(key, std::uint32_t(values.size()));
  if (is_new) values.push_back(value);
  return found->second;
}

std::vector<std::byte> bytes_of(const ImagePlace& place, std::uint64_t most) {
  SceneFilePtr file = place.bytes;
  if (!file) note_looked_for(place.path);
  if (!file && (place.path.empty() || !is_regular_file(place.path)))
    fail(ErrorCode::bad_input, "{}: the image is not there", place.name);
  if (!file) file = open_scene_file(place.path, "", NamedBy::file);
  if (most == kMostBytes && file->size() > kMostBytes)
    fail(ErrorCode::bad_input, "{}: an image of {} MiB; at most {} are read", place.name, file->size() >> 20,
         kMostBytes >> 20);
  std::vector<std::byte> bytes(std::size_t(std::min(most, file->size())));
  bytes.resize(file->read_at(0, bytes));
  return bytes;
}

/// Returns the size of an image's file; 0 if it is missing.
std::uint64_t size_of(const ImagePlace& place) {
  std::error_code missing;
  const std::uintmax_t size = place.bytes ? place.bytes->size() : std::filesystem::file_size(place.path, missing);
  return missing ? 0 : size;
}

/// Turns an image into directions; returns whether that changed it.
bool make_directions(TextureImage& image, const Relief& relief) {
  if (is_grey(image)) {
    turn_into_directions(image, relief);
  } else if (relief.strength != 1) {
    strengthen(image, relief.strength);
  } else {
    return false;
  }
  return true;
}

}  // namespace

std::uint32_t TextureTable::add_image(const std::string& key, ImagePlace place) {
  return number_of(key, place, image_of_, images_);
}

std::uint32_t TextureTable::add_material(const std::string& key, const TextureMaterial& material) {
  return number_of(key, material, material_of_, materials_);
}

bool TextureTable::has_images() const {
  for (std::uint32_t i = 0; i < images_.size(); ++i)
    if (size(i)[0] > 0) return true;
  return false;
}

std::string TextureTable::fault_of(std::uint32_t i) const {
  try {
    (void)size_in_file(i);
    return "";
  } catch (const Error& e) {
    return e.what();
  }
}

ImageFaults TextureTable::image_faults() const {
  ImageFaults faults;
  for (std::uint32_t i = 0; i < images_.size(); ++i) {
    const std::string fault = fault_of(i);
    if (!fault.empty() && ++faults.images == 1) faults.first = fault;
  }
  return faults;
}

std::uint64_t TextureTable::file_bytes() const {
  std::uint64_t sum = 0;
  for (const ImagePlace& place : images_) sum += size_of(place);
  return sum;
}

std::uint64_t TextureTable::written_bytes() const {
  std::uint64_t sum = 0;
  for (std::uint32_t i = 0; i < images_.size(); ++i) {
    const std::array<int, 2> texels = size(i);
    // An image of another kind, or a relief, is encoded anew: PNG adds little to texels that it cannot compress.
    const std::uint64_t decoded = std::uint64_t(texels[0]) * std::uint64_t(texels[1]) * sizeof(TextureImage::Texel);
    const bool is_copied = !images_[i].relief && texels[0] > 0 && is_web_image(bytes_of(images_[i], kMostHead), "");
    sum += is_copied ? size_of(images_[i]) : decoded;
  }
  return sum;
}

std::array<int, 2> TextureTable::size_in_file(std::uint32_t i) const {
  return image_size(bytes_of(images_.at(i), kMostHead), images_.at(i).name);
}

std::array<int, 2> TextureTable::size(std::uint32_t i) const {
  try {
    return size_in_file(i);
  } catch (const Error&) {
    return {};
  }
}

std::vector<std::byte> TextureTable::file(std::uint32_t i) const {
  try {
    std::vector<std::byte> bytes = bytes_of(images_.at(i), kMostBytes);
    const ImagePlace& place = images_.at(i);
    const bool web = is_web_image(bytes, place.name);
    if (!place.relief && web) return bytes;
    const std::uint64_t copies = web ? 1 : 2;
    TextureImage image = decode_image(bytes, place.name, copies * kMostRelief * sizeof(TextureImage::Texel));
    const bool turned = place.relief && make_directions(image, *place.relief);
    if (web && !turned) return bytes;
    const std::string made = encode_texture(image).bytes;
    bytes.resize(made.size());
    std::memcpy(bytes.data(), made.data(), made.size());
    return bytes;
  } catch (const Error&) {
    return {};
  }
}

TextureImage TextureTable::image(std::uint32_t i, std::uint64_t most_bytes) const {
  TextureImage image = decode_image(bytes_of(images_.at(i), kMostBytes), images_.at(i).name, most_bytes);
  if (images_.at(i).relief) (void)make_directions(image, *images_.at(i).relief);
  return image;
}

}  // namespace bp
