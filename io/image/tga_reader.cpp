#include "io/image/tga_reader.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>
// Only TGA: less code that meets broken files. The library's BMP reader returns memory that was never set.
#define STBI_ONLY_TGA
#define STBI_NO_STDIO
#define STBI_NO_LINEAR
#define STBI_MAX_DIMENSIONS (1 << 16)
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#include <stb_image.h>

namespace bp {

namespace {

/// A file in memory that notes whether the decoder asked for more than there is. The decoder gets zeros then.
struct Reading {
  std::span<const std::byte> left;
  bool ended = false;

  static int read(void* self, char* to, int most) {
    auto& reading = *static_cast<Reading*>(self);
    const std::size_t n = std::min(std::size_t(most), reading.left.size());
    reading.ended = reading.ended || n == 0;
    if (n > 0) std::memcpy(to, reading.left.data(), n);
    reading.left = reading.left.subspan(n);
    return int(n);
  }
  static void skip(void* self, int n) {
    auto& reading = *static_cast<Reading*>(self);
    if (n > 0) reading.left = reading.left.subspan(std::min(std::size_t(n), reading.left.size()));
  }
  static int eof(void* self) { return static_cast<Reading*>(self)->left.empty() ? 1 : 0; }
};

/// Returns whether an uncompressed TGA has fewer bytes than its size needs: the decoder takes rows as they come.
bool lacks_rows(std::span<const std::byte> bytes, std::uint64_t texels) {
  const auto at = [&](std::size_t i) { return std::to_integer<std::uint64_t>(bytes[i]); };
  if (at(2) > 3) return false;  // compressed
  const std::uint64_t colors = at(1) == 1 ? (at(5) | at(6) << 8) * ((at(7) + 7) / 8) : 0;
  return bytes.size() < 18 + at(0) + colors + texels * ((at(16) + 7) / 8);
}

constexpr stbi_io_callbacks kCallbacks = {Reading::read, Reading::skip, Reading::eof};

}  // namespace

std::optional<std::array<int, 2>> tga_size(std::span<const std::byte> head) {
  Reading reading{head};
  std::array<int, 2> size{};
  int channels = 0;
  if (stbi_info_from_callbacks(&kCallbacks, &reading, &size[0], &size[1], &channels) == 0) return std::nullopt;
  return size;
}

std::optional<TextureImage> decode_tga_bytes(std::span<const std::byte> bytes) {
  Reading reading{bytes};
  int width = 0, height = 0, channels = 0;
  const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> texels(
      stbi_load_from_callbacks(&kCallbacks, &reading, &width, &height, &channels, 4), &stbi_image_free);
  if (!texels || reading.ended || lacks_rows(bytes, std::uint64_t(width) * std::uint64_t(height))) return std::nullopt;
  TextureImage image(width, height);
  std::memcpy(image.texels.data(), texels.get(), image.texels.size() * sizeof(TextureImage::Texel));
  if (std::all_of(image.texels.begin(), image.texels.end(), [](const TextureImage::Texel& t) { return t[3] == 0; }))
    for (TextureImage::Texel& t : image.texels) t[3] = 255;
  return image;
}

}  // namespace bp
