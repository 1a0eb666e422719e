#include "io/image/texture_writer.h"

#include <algorithm>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
// libjpeg needs <cstdio> before it.
#include <jpeglib.h>
#include <png.h>

#include "lib/core/error.h"

namespace bp {

namespace {

[[noreturn]] void refuse(const char* why) {
  fail(ErrorCode::out_of_resource, "texture: it cannot be compressed ({})", why);
}

/// libjpeg leaves by a jump: between setjmp() and the jump no object with a destructor may live.
struct JpegWriter {
  jpeg_compress_struct codec{};
  struct Fault {
    jpeg_error_mgr manager;
    std::jmp_buf back;
    char message[JMSG_LENGTH_MAX];
  } fault{};
  unsigned char* bytes = nullptr;
  unsigned long size = 0;

  JpegWriter() {
    codec.err = jpeg_std_error(&fault.manager);
    fault.manager.error_exit = [](j_common_ptr c) {
      auto* const f = reinterpret_cast<Fault*>(c->err);
      c->err->format_message(c, f->message);
      std::longjmp(f->back, 1);
    };
  }
  ~JpegWriter() {
    jpeg_destroy_compress(&codec);
    std::free(bytes);
  }
  JpegWriter(const JpegWriter&) = delete;
  JpegWriter& operator=(const JpegWriter&) = delete;

  bool write(const TextureImage::Texel* texels, int width, int height) {
    constexpr int kQuality = 90;
    if (setjmp(fault.back) != 0) return false;
    jpeg_create_compress(&codec);
    jpeg_mem_dest(&codec, &bytes, &size);
    codec.image_width = JDIMENSION(width);
    codec.image_height = JDIMENSION(height);
    codec.input_components = 4;
    codec.in_color_space = JCS_EXT_RGBA;
    jpeg_set_defaults(&codec);
    jpeg_set_quality(&codec, kQuality, TRUE);
    codec.optimize_coding = TRUE;
    // Full colour resolution: charts are small, and half of it would bleed over their edges.
    codec.comp_info[0].h_samp_factor = codec.comp_info[0].v_samp_factor = 1;
    jpeg_start_compress(&codec, TRUE);
    while (codec.next_scanline < codec.image_height) {
      JSAMPROW row = const_cast<JSAMPLE*>(texels[std::size_t(codec.next_scanline) * codec.image_width].data());
      jpeg_write_scanlines(&codec, &row, 1);
    }
    jpeg_finish_compress(&codec);
    return true;
  }
};

std::string jpeg_of(const TextureImage& image) {
  JpegWriter writer;
  if (!writer.write(image.texels.data(), image.width, image.height)) refuse(writer.fault.message);
  return {reinterpret_cast<const char*>(writer.bytes), std::size_t(writer.size)};
}

std::string png_of(const TextureImage& image) {
  struct Writer : png_image {
    Writer() : png_image{} { version = PNG_IMAGE_VERSION; }
    ~Writer() { png_image_free(this); }
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;
  } png;
  png.format = PNG_FORMAT_RGBA;
  png.width = png_uint_32(image.width);
  png.height = png_uint_32(image.height);
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&png, bytes.data(), &size, 0, image.texels.data(), 0, nullptr) == 0)
    refuse(static_cast<const char*>(png.message));
  bytes.resize(size);
  return bytes;
}

}  // namespace

EncodedImage encode_texture(const TextureImage& image) {
  if (image.width <= 0 || image.height <= 0) fail(ErrorCode::bad_argument, "texture: it has no pixels");
  const bool opaque =
      std::all_of(image.texels.begin(), image.texels.end(), [](const TextureImage::Texel& t) { return t[3] == 255; });
  return opaque ? EncodedImage{jpeg_of(image), "image/jpeg"} : EncodedImage{png_of(image), "image/png"};
}

}  // namespace bp
