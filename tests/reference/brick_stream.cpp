#include "tests/reference/brick_stream.h"

#include <xxhash.h>
#include <zstd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

namespace reference {

namespace {

void require(bool good, const char* what) {
  if (!good) throw std::runtime_error(what);
}

/// Reads numbers one byte at a time; never beyond the end.
struct Cursor {
  const std::vector<unsigned char>& file;
  std::size_t at = 0;

  std::uint64_t number(int bytes) {
    require(file.size() - at >= std::size_t(bytes), "truncated");
    std::uint64_t value = 0;
    for (int i = 0; i < bytes; ++i) value += std::uint64_t(file[at++]) << (8 * i);
    return value;
  }
  std::int32_t i32() { return std::int32_t(std::uint32_t(number(4))); }
  double f64() {
    const std::uint64_t bits = number(8);
    double value;
    std::memcpy(&value, &bits, 8);
    return value;
  }
  std::string text(std::size_t n) {
    require(file.size() - at >= n, "truncated");
    std::string t;
    for (std::size_t i = 0; i < n; ++i) t += char(file[at++]);
    return t;
  }
};

struct Slab {
  std::int32_t coordinate;
  std::uint64_t batches, offset, records;
};

struct Reader {
  Cursor in;
  StreamFile out;
  std::vector<Slab> slabs;
  std::vector<std::array<int, 4>> order;  // keys of the records so far, most significant first
  std::uint64_t counts[2][3] = {};
  std::uint64_t low = 0, high = 0;

  std::uint32_t frame() {
    require(in.number(4) == 0x184D2A5B, "not our frame");
    return std::uint32_t(in.number(4));
  }
  void header();
  void orientation(std::uint64_t bytes);
  void exact();
  void batch(std::size_t offset);
  void record(Cursor& heads, Cursor& data, const std::int32_t* first, const std::int32_t* last, bool is_first,
              bool is_last, std::size_t offset);
  void end(std::size_t index_offset, std::uint32_t index_size);
};

void Reader::header() {
  const std::uint32_t size = frame();
  const std::size_t start = in.at;
  require(in.text(8) == "BPVS\r\n\x1a\n", "magic");
  require(in.number(2) == 1, "version");
  const std::uint64_t flags = in.number(2);
  require(flags <= 15 && flags % 2 + flags / 4 % 2 <= 1, "flags");
  const bool oriented = flags / 8 == 1;
  out.has_closing = flags % 2 == 1;
  out.fill = int(in.number(1));
  out.element = int(in.number(1));
  out.slab_axis = int(in.number(1));
  out.up = int(in.number(1));
  require(out.fill <= 3 && out.element <= (out.has_closing ? 1 : 0) && out.slab_axis <= 2 && out.up <= 5,
          "small field");
  out.voxel = in.f64();
  require(out.voxel >= 0x1p-100 && out.voxel <= 0x1p100, "voxel");
  for (std::int64_t& o : out.origin) {
    o = std::int64_t(in.number(8));
    require(o >= -(std::int64_t(1) << 47) && o <= std::int64_t(1) << 47, "origin");
  }
  bool finite = true, none = true;
  for (std::size_t i = 0; i < 6; ++i) {
    out.bounds[i] = in.f64();
    finite = finite && std::isfinite(out.bounds[i]);
    none = none && out.bounds[i] == (i < 3 ? INFINITY : -INFINITY);
  }
  for (std::size_t i = 0; i < 3; ++i) finite = finite && out.bounds[i] <= out.bounds[i + 3];
  require(finite || none, "bounds");
  for (std::int32_t& b : out.box) b = in.i32();
  for (std::size_t i = 0; i < 3; ++i)
    require(out.box[i] >= -33554304 && out.box[i + 3] <= 33554304 && out.box[i] <= out.box[i + 3] &&
                std::int64_t(out.box[i + 3]) - out.box[i] <= 33554304,
            "box");
  exact();
  for (std::size_t i = 0; i < 6 && !none; ++i) {
    const double at = out.bounds[i] / out.voxel - double(out.origin[i % 3]);
    require(at >= 64.0 * out.box[i % 3] && at <= 64.0 * out.box[i % 3 + 3], "bounds beyond the box");
  }
  const std::uint64_t s = in.number(4), p = in.number(4);
  require(s <= 1u << 22 && p >= 2 && p <= 1u << 20 && (s > 0) == (out.has_closing || flags / 4 % 2 == 1) &&
              size >= 136 + s + p,
          "sizes");
  std::uint64_t f = size - 136 - s - p, o = 0;
  if (oriented) {
    require(s > 0 && (!out.has_closing || out.element == 1) && f >= 36, "orientation");
    Cursor last{in.file, start + size - 12};
    require(last.at <= in.file.size(), "truncated");
    o = last.number(4);
    require(o >= 32 && o + 4 <= f, "orientation size");
    f -= o + 4;
  }
  require(flags / 2 % 2 == 1 ? f >= 2 && f <= 1u << 20 : f == 0, "scene files");
  out.scale = in.text(s);
  out.provenance = in.text(p);
  out.scene = in.text(f);
  if (oriented) orientation(o);
  const std::size_t hashed = in.at - start;
  require(in.number(8) == XXH3_64bits(&in.file[start], hashed), "header hash");
}

void Reader::orientation(std::uint64_t bytes) {
  const std::uint64_t edge = in.number(4);
  require(edge >= 8 && edge % 8 == 0 && edge <= 1u << 26, "orientation cell");
  for (int i = 0; i < 3; ++i) require(std::abs(std::int64_t(in.i32())) <= 1 << 28, "orientation origin");
  std::uint64_t cells = 1;
  for (int i = 0; i < 3; ++i) {
    const std::uint64_t n = in.number(4);
    require(n >= 1 && n <= 1u << 18 && cells * n <= 1u << 18, "orientation cells");
    cells *= n;
  }
  const std::uint64_t n = in.number(4);
  require(n >= 1 && n <= 1u << 16 && bytes == 32 + 8 * n + 2 * cells, "orientation size");
  for (std::uint64_t i = 0; i < n; ++i) {
    std::int64_t square = 0;
    for (int k = 0; k < 4; ++k) {
      const auto part = std::int64_t(std::int16_t(in.number(2)));
      square += part * part;
    }
    require(square >= 1 << 27, "quaternion");
  }
  for (std::uint64_t i = 0; i < cells; ++i) require(in.number(2) < n, "orientation of a cell");
  require(in.number(4) == bytes, "orientation size");
}

/// A product of whole numbers that must fit the 53 bits of a double: of 1/64 voxels, and of the voxel's mantissa.
void Reader::exact() {
  std::int64_t far = 0;
  for (std::size_t i = 0; i < 6; ++i)
    far = std::max<std::int64_t>(far, std::abs(out.origin[i % 3] + 64 * std::int64_t(out.box[i])) + 2048);
  int bits = 0;
  for (std::int64_t n = 64 * far; n > 0; n /= 2) ++bits;
  int exponent = 0;
  double mantissa = std::frexp(out.voxel, &exponent);
  for (; mantissa != 0; mantissa = 2 * mantissa - std::floor(2 * mantissa)) ++bits;
  require(bits <= 53, "not exact");
}

void Reader::record(Cursor& heads, Cursor& data, const std::int32_t* first, const std::int32_t* last, bool is_first,
                    bool is_last, std::size_t offset) {
  std::vector<unsigned char> hashed(heads.file.begin() + std::ptrdiff_t(heads.at),
                                    heads.file.begin() + std::ptrdiff_t(heads.at) + 16);
  std::int32_t c[3];
  for (int i = 0; i < 3; ++i) {
    c[i] = heads.i32();
    require(c[i] >= out.box[std::size_t(i)] && c[i] < out.box[std::size_t(i + 3)], "outside the box");
    if (is_first) require(c[i] == first[i], "first");
    if (is_last) require(c[i] == last[i], "last");
  }
  const int layer = int(heads.number(1)), fill = int(heads.number(1));
  require(layer <= (out.has_closing ? 1 : 0) && (fill == 1 || fill == 2) && heads.number(2) == 0, "record");
  const int axis = out.slab_axis;
  require(c[axis] == first[axis], "one slab");
  order.push_back({c[axis], c[axis == 2 ? 1 : 2], c[axis == 0 ? 1 : 0], layer});
  require(order.size() < 2 || order[order.size() - 2] < order.back(), "order");

  Voxels voxels(64 * 64 * 64, true);
  hashed[13] = 0;
  for (std::size_t i = 0; i < 32768; ++i) {
    const unsigned byte = fill == 1 ? 255u : unsigned(data.number(1));
    hashed.push_back(static_cast<unsigned char>(byte));
    const std::size_t k = i / 4096, z = i / 64 % 64, y = i % 64;
    for (std::size_t bit = 0; bit < 8; ++bit) {
      voxels[(z * 64 + y) * 64 + 8 * k + bit] = byte >> bit & 1u;
      counts[layer][2] += byte >> bit & 1u;
    }
  }
  bool any = false, all = true;
  for (const bool v : voxels) any = any || v, all = all && v;
  require(fill == 1 || (any && !all), "canonical");
  counts[layer][0] += 1;
  counts[layer][1] += fill == 1;
  const XXH128_hash_t hash = XXH3_128bits(hashed.data(), hashed.size());
  low += hash.low64;
  high += hash.high64 + (low < hash.low64 ? 1 : 0);
  out.bricks[{layer, c[0], c[1], c[2]}] = std::move(voxels);
  if (is_first) {
    if (slabs.empty() || slabs.back().coordinate != c[axis]) slabs.push_back({c[axis], 0, offset, 0});
    ++slabs.back().batches;
  }
  ++slabs.back().records;
}

void Reader::batch(std::size_t offset) {
  const std::uint64_t records = in.number(4), raw = in.number(4), packed = in.number(4);
  std::int32_t first[3], last[3];
  for (std::int32_t& x : first) x = in.i32();
  for (std::int32_t& x : last) x = in.i32();
  require(records >= 1 && records <= 4096 && packed >= 1 && packed <= 1179648 && raw >= 16 * records, "batch head");
  require((raw - 16 * records) % 32768 == 0 && (raw - 16 * records) / 32768 <= 32, "batch size");
  require(in.file.size() - in.at >= packed, "truncated");
  const unsigned char* frame = &in.file[in.at];
  require(packed > 4 && (frame[4] & 4) != 0, "no checksum");
  require(ZSTD_findFrameCompressedSize(frame, packed) == packed && ZSTD_getFrameContentSize(frame, packed) == raw,
          "zstd frame");
  std::vector<unsigned char> content(raw);
  require(ZSTD_decompress(content.data(), raw, frame, packed) == raw, "zstd content");
  in.at += packed;
  Cursor heads{content}, data{content, 16 * records};
  for (std::uint64_t i = 0; i < records; ++i) record(heads, data, first, last, i == 0, i + 1 == records, offset);
  require(data.at == raw, "batch size");
}

void Reader::end(std::size_t index_offset, std::uint32_t index_size) {
  require(in.number(4) == slabs.size() && index_size == 16 + 24 * slabs.size(), "index size");
  const std::size_t start = in.at;
  for (const Slab& slab : slabs) {
    require(in.i32() == slab.coordinate && in.number(4) == slab.batches && in.number(8) == slab.offset &&
                in.number(8) == slab.records,
            "index");
  }
  const std::uint64_t index_hash = XXH3_64bits(in.file.data() + start, in.at - start);
  require(in.number(8) == index_hash, "index hash");
  require(frame() == 96, "end record size");
  const std::size_t payload = in.at;
  require(in.text(4) == "TAIL" && in.number(4) == 0, "end record");
  for (const auto& layer : counts) {
    for (const std::uint64_t count : layer) require(in.number(8) == count, "counts");
  }
  require(in.number(8) == low && in.number(8) == high, "content checksum");
  require(in.number(8) == index_offset, "index offset");
  require(in.number(8) == in.at + 8, "size");
  require(in.number(8) == XXH3_64bits(&in.file[payload], 88), "end hash");
  require(in.at == in.file.size(), "trailing bytes");
  char text[33];
  std::snprintf(text, sizeof text, "%016llx%016llx", static_cast<unsigned long long>(high),
                static_cast<unsigned long long>(low));
  out.checksum = text;
}

}  // namespace

StreamFile read_stream(const std::vector<unsigned char>& file) {
  Reader reader{{file}, {}, {}, {}};
  reader.header();
  for (;;) {
    const std::size_t offset = reader.in.at;
    const std::uint32_t size = reader.frame();
    const std::string tag = reader.in.text(4);
    if (tag == "INDX") {
      reader.end(offset, size);
      return reader.out;
    }
    require(tag == "BTCH" && size == 40, "tag");
    reader.batch(offset);
  }
}

}  // namespace reference
