#include "io/image/image_reader.h"

#include <csetjmp>
#include <cstdio>
#include <cstring>
// libjpeg needs <cstdio> before it.
#include <jpeglib.h>
#include <png.h>
#include <webp/decode.h>

#include "io/image/tga_reader.h"
#include "lib/core/error.h"

namespace bp {

namespace {

const unsigned char* raw(std::span<const std::byte> bytes) {
  return reinterpret_cast<const unsigned char*>(bytes.data());
}

void check_size(std::uint64_t width, std::uint64_t height, const std::string& name, int copies,
                std::uint64_t most_bytes) {
  constexpr std::uint64_t kMostPixels = std::uint64_t(1) << 28, kMostSide = 1 << 16;
  if (width == 0 || height == 0 || width > kMostSide || height > kMostSide || width * height > kMostPixels)
    fail(ErrorCode::bad_input, "{}: an image of {} x {} pixels; at most 2^28 are read", name, width, height);
  const std::uint64_t bytes = std::uint64_t(copies) * width * height * sizeof(TextureImage::Texel);
  if (bytes > most_bytes) throw NeedsMemory(fmt::format("{}: the image", name), bytes, most_bytes, 0);
}

/// Returns an empty image of this size. Throws if it would be too large.
TextureImage sized(std::uint64_t width, std::uint64_t height, const std::string& name, std::uint64_t most_bytes) {
  check_size(width, height, name, 1, most_bytes);
  return {int(width), int(height)};
}

[[noreturn]] void broken(const std::string& name, const char* why) {
  fail(ErrorCode::bad_input, "{}: the image cannot be read: {}", name, why);
}

struct PngReader : png_image {
  PngReader(std::span<const std::byte> bytes, const std::string& name) : png_image{} {
    version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_memory(this, bytes.data(), bytes.size()) == 0)
      broken(name, static_cast<const char*>(message));
  }
  ~PngReader() { png_image_free(this); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;
};

TextureImage decode_png(std::span<const std::byte> bytes, const std::string& name, std::uint64_t most_bytes) {
  PngReader png(bytes, name);
  png.format = PNG_FORMAT_RGBA;
  TextureImage image = sized(png.width, png.height, name, most_bytes);
  if (png_image_finish_read(&png, nullptr, image.texels.data(), 0, nullptr) == 0)
    broken(name, static_cast<const char*>(png.message));
  return image;
}

/// libjpeg leaves by a jump: between setjmp() and the jump no object with a destructor may live.
struct JpegFault {
  jpeg_error_mgr manager;
  std::jmp_buf back;
  char message[JMSG_LENGTH_MAX];
};

void leave_jpeg(j_common_ptr codec) {
  auto* const fault = reinterpret_cast<JpegFault*>(codec->err);
  codec->err->format_message(codec, fault->message);
  std::longjmp(fault->back, 1);
}

struct JpegReader {
  jpeg_decompress_struct codec{};
  JpegFault fault{};
  JpegReader() {
    codec.err = jpeg_std_error(&fault.manager);
    fault.manager.error_exit = leave_jpeg;
    fault.manager.output_message = [](j_common_ptr) {};
  }
  ~JpegReader() { jpeg_destroy_decompress(&codec); }
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;

  bool begin(const unsigned char* bytes, std::size_t size) {
    if (setjmp(fault.back) != 0) return false;
    jpeg_create_decompress(&codec);
    jpeg_mem_src(&codec, bytes, size);
    jpeg_read_header(&codec, TRUE);
    codec.out_color_space = JCS_EXT_RGBA;
    return true;
  }
  bool read(TextureImage::Texel* texels) {
    if (setjmp(fault.back) != 0) return false;
    jpeg_start_decompress(&codec);
    while (codec.output_scanline < codec.output_height) {
      JSAMPROW row = texels[std::size_t(codec.output_scanline) * codec.output_width].data();
      jpeg_read_scanlines(&codec, &row, 1);
    }
    jpeg_finish_decompress(&codec);
    return true;
  }
};

TextureImage decode_jpeg(std::span<const std::byte> bytes, const std::string& name, std::uint64_t most_bytes) {
  JpegReader reader;
  if (!reader.begin(raw(bytes), bytes.size())) broken(name, reader.fault.message);
  TextureImage image = sized(reader.codec.image_width, reader.codec.image_height, name, most_bytes);
  if (!reader.read(image.texels.data())) broken(name, reader.fault.message);
  return image;
}

std::array<int, 2> webp_size(std::span<const std::byte> bytes, const std::string& name) {
  std::array<int, 2> size{};
  if (WebPGetInfo(raw(bytes), bytes.size(), &size[0], &size[1]) == 0) broken(name, "no WebP image");
  return size;
}

TextureImage decode_webp(std::span<const std::byte> bytes, const std::string& name, std::uint64_t most_bytes) {
  const auto [width, height] = webp_size(bytes, name);
  TextureImage image = sized(std::uint64_t(width), std::uint64_t(height), name, most_bytes);
  if (WebPDecodeRGBAInto(raw(bytes), bytes.size(), image.texels.front().data(), image.texels.size() * 4, width * 4) ==
      nullptr)
    broken(name, "broken WebP data");
  return image;
}

TextureImage decode_tga(std::span<const std::byte> bytes, const std::string& name, std::uint64_t most_bytes) {
  const auto [width, height] = *tga_size(bytes);
  check_size(std::uint64_t(width), std::uint64_t(height), name, 2, most_bytes);
  std::optional<TextureImage> image = decode_tga_bytes(bytes);
  if (!image) broken(name, "broken TGA data");
  return std::move(*image);
}

/// Returns the name of an image format that is not read, by the first bytes; null if they are of none.
const char* foreign_image(std::span<const std::byte> bytes) {
  struct Foreign {
    std::string_view magic;
    const char* name;
  };
  using namespace std::string_view_literals;
  constexpr std::array<Foreign, 9> kKnown{{{"\xABKTX 20\xBB", "it is KTX2"},
                                           {"\xABKTX 11\xBB", "it is KTX"},
                                           {"DDS ", "it is DDS"},
                                           {"II*\0"sv, "it is TIFF"},
                                           {"MM\0*"sv, "it is TIFF"},
                                           {"\x76\x2F\x31\x01", "it is OpenEXR"},
                                           {"8BPS", "it is a Photoshop file"},
                                           {"GIF8", "it is GIF"},
                                           {"BM", "it is BMP"}}};
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  for (const auto& [magic, name] : kKnown) {
    if (text.starts_with(magic)) return name;
  }
  return nullptr;
}

enum class ImageKind { png, jpeg, webp, tga };

ImageKind kind_of(std::span<const std::byte> bytes, const std::string& name) {
  const auto begins = [&](std::size_t at, std::string_view magic) {
    return bytes.size() >= at + magic.size() && std::memcmp(bytes.data() + at, magic.data(), magic.size()) == 0;
  };
  if (begins(0, "\x89PNG")) return ImageKind::png;
  if (begins(0, "\xFF\xD8")) return ImageKind::jpeg;
  if (begins(0, "RIFF") && begins(8, "WEBP")) return ImageKind::webp;
  if (tga_size(bytes)) return ImageKind::tga;
  if (const char* const foreign = foreign_image(bytes))
    broken(name, fmt::format("{}, and PNG, JPEG, WebP and TGA are read", foreign).c_str());
  broken(name, "it is no PNG, JPEG, WebP or TGA");
}

}  // namespace

TextureImage decode_image(std::span<const std::byte> bytes, const std::string& name, std::uint64_t most_bytes) {
  switch (kind_of(bytes, name)) {
    case ImageKind::png:
      return decode_png(bytes, name, most_bytes);
    case ImageKind::jpeg:
      return decode_jpeg(bytes, name, most_bytes);
    case ImageKind::tga:
      return decode_tga(bytes, name, most_bytes);
    case ImageKind::webp:
      break;
  }
  return decode_webp(bytes, name, most_bytes);
}

bool is_web_image(std::span<const std::byte> bytes, const std::string& name) {
  return kind_of(bytes, name) != ImageKind::tga;
}

std::array<int, 2> image_size(std::span<const std::byte> head, const std::string& name) {
  switch (kind_of(head, name)) {
    case ImageKind::png: {
      const PngReader png(head, name);
      return {int(png.width), int(png.height)};
    }
    case ImageKind::jpeg: {
      JpegReader reader;
      if (!reader.begin(raw(head), head.size())) broken(name, reader.fault.message);
      return {int(reader.codec.image_width), int(reader.codec.image_height)};
    }
    case ImageKind::tga:
      return *tga_size(head);
    case ImageKind::webp:
      break;
  }
  return webp_size(head, name);
}

}  // namespace bp
