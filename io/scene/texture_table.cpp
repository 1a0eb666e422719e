#include "io/scene/texture_table.h"

#include <filesystem>

#include "io/image/image_reader.h"
#include "lib/core/error.h"

namespace bp {

namespace {

constexpr std::uint64_t kMostBytes = std::uint64_t(512) << 20;  // of an image as it lies in its file

template <class T>
std::uint32_t number_of(const std::string& key, const T& value, std::map<std::string, std::uint32_t>& numbers,
                        std::vector<T>& values) {
  const auto [found, is_new] = numbers.try_emplace(key, std::uint32_t(values.size()));
  if (is_new) values.push_back(value);
  return found->second;
}

SceneFilePtr open(const ImagePlace& place) {
  if (place.bytes) return place.bytes;
  std::error_code unknown;  // a pipe would wait for ever
  if (place.path.empty() || !std::filesystem::is_regular_file(place.path, unknown))
    fail(ErrorCode::bad_input, "{}: the image is not there", place.name);
  return open_scene_file(place.path, "");
}

}  // namespace

std::uint32_t TextureTable::add_image(const std::string& key, ImagePlace place) {
  return number_of(key, place, image_of_, images_);
}

std::uint32_t TextureTable::add_material(const std::string& key, const TextureMaterial& material) {
  return number_of(key, material, material_of_, materials_);
}

TextureImage TextureTable::image(std::uint32_t i, std::uint64_t most_bytes) const {
  const ImagePlace& place = images_.at(i);
  const SceneFilePtr file = open(place);
  if (file->size() > kMostBytes)
    fail(ErrorCode::bad_input, "{}: an image of {} MiB; at most {} are read", place.name, file->size() >> 20,
         kMostBytes >> 20);
  std::vector<std::byte> bytes(std::size_t(file->size()));
  bytes.resize(file->read_at(0, bytes));
  return decode_image(bytes, place.name, most_bytes);
}

}  // namespace bp
