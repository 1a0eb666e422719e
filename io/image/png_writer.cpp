#include "io/image/png_writer.h"

#include <png.h>

#include <algorithm>

#include "io/files/lower.h"
#include "lib/core/error.h"

namespace bp {

namespace {

struct PngImage : png_image {
  explicit PngImage(const Image& image) : png_image{} {
    version = PNG_IMAGE_VERSION;
    format = PNG_FORMAT_RGB;
    width = png_uint_32(image.width), height = png_uint_32(image.height);
  }
  ~PngImage() { png_image_free(this); }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
};

}  // namespace

std::vector<std::byte> encode_png(const Image& image) {
  if (image.width <= 0 || image.height <= 0) fail(ErrorCode::bad_argument, "image: it has no pixels");
  static_assert(sizeof(Color) == 3, "pixels lie as PNG_FORMAT_RGB has them");
  PngImage png(image);
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
  std::vector<std::byte> bytes(size);
  if (png_image_write_to_memory(&png, bytes.data(), &size, 0, image.pixels.data(), 0, nullptr) == 0)
    fail(ErrorCode::out_of_resource, "image: it cannot be compressed ({})", static_cast<const char*>(png.message));
  bytes.resize(size);
  return bytes;
}

void check_png_name(const std::string& path) {
  const std::string end = lower(path.substr(path.size() - std::min<std::size_t>(path.size(), 4)));
  if (!path.empty() && end != ".png")
    fail(ErrorCode::bad_argument, "{}: pictures are PNG; end the name with .png", path);
}

void write_png(const Image& image, const std::string& path, bool overwrite) {
  OutputFile file(path, overwrite);
  file.write(encode_png(image));
  file.commit();
}

}  // namespace bp
