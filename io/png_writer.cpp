// PNG (ISO/IEC 15948): signature, IHDR, one IDAT, IEND.
#include "io/png_writer.h"

#include <zlib.h>

#include <algorithm>
#include <cstdlib>

#include "io/detail/lower.h"
#include "lib/core/error.h"

namespace bp {

namespace {

using Bytes = std::vector<std::uint8_t>;

void append_u32(Bytes& out, std::uint32_t v) {
  for (int shift = 24; shift >= 0; shift -= 8) out.push_back(std::uint8_t(v >> shift));
}

void append_chunk(Bytes& out, const char (&type)[5], const Bytes& data) {
  append_u32(out, std::uint32_t(data.size()));
  const std::size_t begin = out.size();
  out.insert(out.end(), type, type + 4);
  out.insert(out.end(), data.begin(), data.end());
  append_u32(out, std::uint32_t(crc32(0, out.data() + begin, uInt(out.size() - begin))));
}

Bytes header(const Image& image) {
  Bytes h;
  append_u32(h, std::uint32_t(image.width));
  append_u32(h, std::uint32_t(image.height));
  h.insert(h.end(), {8, 2, 0, 0, 0});  // bits per channel, RGB, deflate, adaptive filters, not interlaced
  return h;
}

/// Rows filtered by the difference from the row above: flat pictures become mostly zeros.
Bytes filtered(const Image& image) {
  Bytes out;
  out.reserve(std::size_t(image.height) * (3 * std::size_t(image.width) + 1));
  for (int y = 0; y < image.height; ++y) {
    out.push_back(2);
    for (int x = 0; x < image.width; ++x) {
      const Color c = image.at(x, y), above = y > 0 ? image.at(x, y - 1) : Color{};
      out.push_back(std::uint8_t(c.r - above.r));
      out.push_back(std::uint8_t(c.g - above.g));
      out.push_back(std::uint8_t(c.b - above.b));
    }
  }
  return out;
}

Bytes deflated(const Bytes& data) {
  uLongf size = compressBound(uLong(data.size()));
  Bytes out(size);
  if (compress2(out.data(), &size, data.data(), uLong(data.size()), 6) != Z_OK)
    fail(ErrorCode::out_of_resource, "image: not enough memory to compress it; ask for a smaller one");
  out.resize(size);
  return out;
}

}  // namespace

std::vector<std::byte> encode_png(const Image& image) {
  if (image.width <= 0 || image.height <= 0) fail(ErrorCode::bad_argument, "image: it has no pixels");
  Bytes out = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  append_chunk(out, "IHDR", header(image));
  append_chunk(out, "IDAT", deflated(filtered(image)));
  append_chunk(out, "IEND", {});
  std::vector<std::byte> bytes(out.size());
  for (std::size_t i = 0; i < out.size(); ++i) bytes[i] = std::byte(out[i]);
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
