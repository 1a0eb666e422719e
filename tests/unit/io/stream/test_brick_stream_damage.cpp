#include <xxhash.h>
#include <zstd.h>

#include <cstdio>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>
#include <random>

#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "tests/catch.h"
#include "tests/unit/io/stream/stream_files.h"

using namespace bp;
using namespace stream_files;

namespace {

bool says(const std::string& message, const std::string& part) {
  CAPTURE(message, part);
  return message.find(part) != std::string::npos;
}

template <class T>
T get(const Bytes& b, std::size_t at) {
  T value;
  std::memcpy(&value, &b[at], sizeof(T));
  return value;
}
template <class T>
void put(Bytes& b, std::size_t at, T value) {
  std::memcpy(&b[at], &value, sizeof(T));
}

/// Makes the hash of the header fit again, so that what lies behind it is tested.
void seal_header(Bytes& b) {
  const std::size_t size = get<std::uint32_t>(b, 4);
  put(b, 8 + size - 8, std::uint64_t(XXH3_64bits(&b[8], size - 8)));
}
void seal_end(Bytes& b) {
  put(b, b.size() - 8, std::uint64_t(XXH3_64bits(&b[b.size() - 96], 88)));
}

/// Offset of the batch head frame (after the header).
std::size_t first_batch(const Bytes& b) {
  return 8 + get<std::uint32_t>(b, 4);
}

/// Replaces the content of the first batch by what `change` makes of it, compressed anew.
Bytes with_content(const Bytes& b, const std::function<void(Bytes&)>& change, bool checksum = true) {
  const std::size_t head = first_batch(b), frame = head + 48, packed = get<std::uint32_t>(b, head + 20);
  Bytes content(get<std::uint32_t>(b, head + 16));
  REQUIRE(ZSTD_decompress(content.data(), content.size(), &b[frame], packed) == content.size());
  change(content);
  Bytes out(ZSTD_compressBound(content.size()));
  ZSTD_CCtx* c = ZSTD_createCCtx();
  ZSTD_CCtx_setParameter(c, ZSTD_c_checksumFlag, checksum ? 1 : 0);
  out.resize(ZSTD_compress2(c, out.data(), out.size(), content.data(), content.size()));
  ZSTD_freeCCtx(c);
  Bytes result(b.begin(), b.begin() + std::ptrdiff_t(frame));
  put(result, head + 16, std::uint32_t(content.size()));
  put(result, head + 20, std::uint32_t(out.size()));
  result.insert(result.end(), out.begin(), out.end());
  result.insert(result.end(), b.begin() + std::ptrdiff_t(frame + packed), b.end());
  return result;
}

/// Four bricks in two slabs: mixed, full, mixed; mixed.
Bytes four_bricks(bool has_closing = false) {
  StreamHeader h = small_header();
  h.bricks = {{0, 0, 0}, {3, 1, 2}};
  h.slab_axis = 2;
  h.has_closing = has_closing;
  h.element = StructuringElement::ball;
  std::vector<Brick> bricks(4, small_bricks()[0]);
  bricks[1].coord = {1, 0, 0};
  bricks[1].fill = BrickFill::full;
  bricks[1].bits.fill(~std::uint64_t(0));
  bricks[2].coord = {2, 0, 0};
  bricks[3].coord = {1, 0, 1};
  return written(h, bricks);
}

}  // namespace

TEST_CASE("every prefix of a stream is reported as truncated", "[quick][io]") {
  const Bytes whole = written(small_header(), small_bricks());
  CHECK(error_of(whole).empty());
  CHECK(says(error_of({}), "is empty"));
  for (std::size_t n = 1; n < whole.size(); ++n) {
    const std::string message = error_of(Bytes(whole.begin(), whole.begin() + std::ptrdiff_t(n)));
    if (message.find(fmt::format("truncated: it ends at byte {},", n)) == std::string::npos)
      FAIL_CHECK("prefix of " << n << " bytes: " << message);
  }
}

TEST_CASE("every changed byte of a stream is reported or harmless", "[quick][io]") {
  const bool four = GENERATE(false, true);
  const Bytes whole = four ? four_bricks() : written(small_header(), small_bricks());
  const Content expected = read_back(whole);
  int harmless = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    for (int flip = four ? 16 : 1; flip < 256; flip *= four ? 4 : 2) {
      Bytes changed = whole;
      changed[i] ^= static_cast<unsigned char>(flip);
      if (!error_of(changed).empty()) continue;
      ++harmless;
      UNSCOPED_INFO("harmless: byte " << i << " of " << whole.size() << " changed by " << flip);
      const Content content = read_back(changed);
      if (!(content.header == expected.header && same(content.bricks, expected.bricks)))
        FAIL_CHECK("byte " << i << " changed by " << flip << " goes unnoticed");
    }
  }
  // Decoders of zstd ignore three bits: one of the frame header, two of the sequences header.
  CHECK(harmless <= (four ? 2 : 3));
}

TEST_CASE("bytes after the end are reported", "[quick][io]") {
  Bytes b = written(small_header(), small_bricks());
  const std::size_t n = b.size();
  b.push_back(0);
  CHECK(says(error_of(b), fmt::format("byte {}: bytes follow the end record", n)));
  b.resize(n);
  const Bytes copy = b;
  b.insert(b.end(), copy.begin(), copy.end());
  CHECK(says(error_of(b), "streams cannot be joined"));
}

TEST_CASE("a file of another kind is called by its name", "[quick][io]") {
  const auto named = [](const std::string& s) { return error_of(Bytes(s.begin(), s.end())); };
  CHECK(says(named("\x89PNG\r\n\x1a\n...................."), "looks like a PNG image, not a stream of voxels"));
  CHECK(says(named("glTF\x02.................."), "a GLB scene"));
  CHECK(says(named("ply\nformat ascii 1.0\n"), "a PLY mesh"));
  CHECK(says(named("{\"asset\":{}}          "), "a JSON or glTF file"));
  CHECK(says(named("\x28\xb5\x2f\xfd................."), "a zstd file of something else"));
  CHECK(says(named("v 0 0 0\nv 1 1 1\n......"), "an OBJ mesh"));
  CHECK(says(named("hello"), "not a stream of voxels; it begins with 'hello'; bpvox makes one"));
  CHECK(says(named("\x01\x02hello"), "not a stream of voxels; bpvox makes one"));
  CHECK(says(named(std::string("\x5b\x2a\x4d\x18\x05\x00\x00\x00\x42PWT\r\n\x1a\n..", 18)),
             "holds weights, not a stream of voxels; bpinfo and bpdeform read them"));
  CHECK(says(named(std::string("\x5b\x2a\x4d\x18\x05\x00\x00\x00 hello hello", 19)), "a zstd file of something else"));
  Bytes text = written(small_header(), small_bricks());
  text[12] = '\n';
  CHECK(says(error_of(text), "text mode"));
}

TEST_CASE("a version, flag or value from the future is refused", "[quick][io]") {
  const Bytes good = four_bricks(true);
  const auto changed = [&](std::size_t at, unsigned char value) {
    Bytes b = good;
    b[8 + at] = value;
    seal_header(b);
    return error_of(b);
  };
  CHECK(says(changed(8, 2), "byte 16: version 2 of the stream of voxels; this tool reads version 1"));
  CHECK(says(changed(10, 3), "scene files without their flag, or the flag without them"));
  CHECK(says(changed(10, 17), "flags of a later version"));
  CHECK(says(changed(10, 5), "a closing, and a scale field for a closing to come"));
  CHECK(says(changed(12, 4), "unknown fill mode 4"));
  CHECK(says(changed(13, 2), "unknown element 2"));
  CHECK(says(changed(14, 3), "slab axis"));
  CHECK(says(changed(15, 6), "unknown up axis 6"));
  CHECK(says(changed(10, 0), "a scale field without its flag"));
  CHECK(changed(12, 1).empty());  // a legal change, which shows that sealing works
}

TEST_CASE("a header out of range is refused even with a valid checksum", "[quick][io]") {
  const Bytes good = four_bricks(true);
  const auto with = [&](std::size_t at, auto value) {
    Bytes b = good;
    put(b, 8 + at, value);
    seal_header(b);
    return error_of(b);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  for (const double voxel : {0.0, -1.0, nan, infinity, 1e-320}) CHECK(says(with(16, voxel), "voxel size"));
  CHECK(says(with(24, std::numeric_limits<std::int64_t>::min()), "origin"));
  CHECK(says(with(48, nan), "bounds"));
  CHECK(says(with(48, infinity), "bounds"));
  CHECK(says(with(96, std::int32_t(4)), "brick box"));
  CHECK(says(with(108, std::numeric_limits<std::int32_t>::max()), "brick box"));
  CHECK(says(with(120, std::uint32_t(0xffffffff)), "sizes in the header disagree"));
  CHECK(says(with(128, std::uint8_t('x')), "not valid JSON"));
  Bytes b = good;
  b[4] = b[5] = b[6] = b[7] = 0xff;
  CHECK(says(error_of(b), "byte 4: a header of 4294967295 bytes cannot be"));
  const std::size_t size = get<std::uint32_t>(good, 4);
  CHECK(says(with(size - 9, std::uint8_t('}')), "provenance"));
}

TEST_CASE("scene files in a header that are none are refused", "[quick][io]") {
  StreamHeader h = small_header();
  h.scene = {{{"scene.ply", 3}}, "", 12, std::string(32, 'a')};
  const Bytes good = written(h, small_bricks());
  CHECK(error_of(good).empty());
  const std::string text(good.begin(), good.end());
  const auto with = [&](const std::string& old, const std::string& now) {
    REQUIRE(old.size() == now.size());
    Bytes b = good;
    std::copy(now.begin(), now.end(), b.begin() + std::ptrdiff_t(text.find(old)));
    seal_header(b);
    return error_of(b);
  };
  const std::string wrong = "the scene files are not what they should be";
  CHECK(says(with("scene.ply", std::string("scene\0ply", 9)), wrong));
  CHECK(says(with("\"scene.ply\"", "\"-\"        "), wrong));
  CHECK(says(with("scene.ply", "\\u001b[2J"), wrong));
  CHECK(says(with("\"bytes\":3", "\"bytes\": "), wrong));
  CHECK(says(with("\"triangles\":12", "\"triangles\":-1"), wrong));
  CHECK(says(with("\"hash\":\"aa", "\"hash\":\"xa"), wrong));
  CHECK(says(with("\"format\"", "\"farmot\""), wrong));
  CHECK(says(with("{\"files", "[\"files"), wrong));
}

TEST_CASE("a scale field that no grid can hold is refused", "[quick][io]") {
  StreamHeader h = small_header();
  h.has_closing = true;
  h.scale.base = 5000 * h.frame.voxel;
  CHECK(says(error_of(written(h, {})), "more than 4095"));
}

TEST_CASE("deep nesting in a header costs nothing", "[quick][io]") {
  StreamHeader h = small_header();
  h.provenance[0].options.assign(1 << 19, 'x');
  Bytes b = written(h, {});
  const std::size_t size = get<std::uint32_t>(b, 4);
  for (std::size_t i = 128; i < size - 8; ++i) b[8 + i] = '[';
  seal_header(b);
  CHECK(says(error_of(b), "provenance"));
}

TEST_CASE("bricks that break the rules are named", "[quick][io]") {
  const Bytes good = four_bricks();
  CHECK(error_of(with_content(good, [](Bytes&) {})).find("index") != std::string::npos);  // offsets moved
  const auto with = [&](auto change) { return error_of(with_content(good, change)); };
  const std::string where = fmt::format("byte {}: batch of bricks (0,0,0) to (2,0,0): ", first_batch(good));
  CHECK(says(with([](Bytes& c) { put(c, 16, std::int32_t(0)); }), where + "brick (0,0,0): is out of order"));
  CHECK(says(with([](Bytes& c) { put(c, 16, std::int32_t(7)); }), where + "brick (7,0,0): lies outside the brick box"));
  CHECK(says(with([](Bytes& c) { put(c, 40, std::int32_t(1)); }), where + "brick (2,0,1): is of another slab"));
  CHECK(says(with([](Bytes& c) { put(c, 12, std::uint8_t(1)); }),
             where + "brick (0,0,0): layer 1 is not in this stream"));
  CHECK(says(with([](Bytes& c) { put(c, 13, std::uint8_t(3)); }), where + "brick (0,0,0): unknown fill 3"));
  CHECK(says(with([](Bytes& c) { put(c, 13, std::uint8_t(0)); }), where + "brick (0,0,0): unknown fill 0"));
  CHECK(says(with([](Bytes& c) { put(c, 14, std::uint8_t(1)); }), where + "brick (0,0,0): reserved"));
  CHECK(says(with([](Bytes& c) { put(c, 13, std::uint8_t(1)); }), where + "1 mixed bricks do not fit"));
  CHECK(says(with([](Bytes& c) { std::fill(c.begin() + 48, c.begin() + 48 + 32768, 0); }),
             where + "brick (0,0,0): is called mixed"));
  CHECK(says(with([](Bytes& c) { std::fill(c.begin() + 48 + 32768, c.end(), 255); }),
             where + "brick (2,0,0): is called mixed"));
  CHECK(says(error_of(with_content(
                 good, [](Bytes&) {}, false)),
             where + "the zstd frame has no checksum"));
  Bytes b = good;
  put(b, first_batch(b) + 24, std::int32_t(1));
  CHECK(says(error_of(b), "brick (0,0,0): is not the first"));
  b = good;
  put(b, first_batch(b) + 36, std::int32_t(1));
  CHECK(says(error_of(b), "brick (2,0,0): is not the last"));
}

TEST_CASE("changed voxels are noticed by the content checksum even if every other checksum was made to fit",
          "[quick][io]") {
  const Bytes good = written(small_header(), small_bricks());
  Bytes b = with_content(good, [](Bytes& c) {
    c[16 + 4096 + 64 + 2] = 0;  // move the voxel: the counts stay
    c[16 + 4096 + 64 + 3] = 2;
  });
  const std::size_t shift = b.size() - good.size();  // wraps; sums are right all the same
  put(b, b.size() - 24, get<std::uint64_t>(b, b.size() - 24) + shift);
  put(b, b.size() - 16, get<std::uint64_t>(b, b.size() - 16) + shift);
  seal_end(b);
  CHECK(says(error_of(b), "the end record counts other bricks or voxels"));
}

TEST_CASE("batches in the wrong order are noticed", "[quick][io]") {
  const Bytes good = four_bricks();
  const std::size_t a = first_batch(good), n = 48 + get<std::uint32_t>(good, a + 20);
  const std::size_t m = 48 + get<std::uint32_t>(good, a + n + 20);
  Bytes b = good;
  std::rotate(b.begin() + std::ptrdiff_t(a), b.begin() + std::ptrdiff_t(a + n), b.begin() + std::ptrdiff_t(a + n + m));
  CHECK(says(error_of(b), fmt::format("byte {}: brick (0,0,0): is out of order", a + m)));
  Bytes missing = good;
  missing.erase(missing.begin() + std::ptrdiff_t(a), missing.begin() + std::ptrdiff_t(a + n));
  CHECK(says(error_of(missing), "the index is of 2 slabs, the stream of 1"));
}

TEST_CASE("the bricks before a damage are the same for any number of threads", "[quick][io]") {
  StreamHeader h = small_header();
  h.bricks.max = {1, 1, 12};
  std::vector<Brick> bricks(12, small_bricks()[0]);
  for (int i = 0; i < 12; ++i) bricks[std::size_t(i)].coord.z = i;
  Bytes b = written(h, bricks);
  std::size_t at = first_batch(b);
  for (int i = 0; i < 5; ++i) at += 48 + get<std::uint32_t>(b, at + 20);
  b[at + 60] ^= 0x55;        // the sixth batch
  b.resize(b.size() - 300);  // and the end is gone: not what is reported
  const TempFile file(b);
  for (const int threads : {1, 2, 8}) {
    const ThreadLimit limit(threads);
    BrickReader reader(file.path());
    Brick got;
    int count = 0;
    std::string message;
    try {
      while (reader.read(got)) ++count;
    } catch (const Error& e) {
      message = e.what();
    }
    CHECK(count == 5);
    CHECK(says(message, fmt::format("byte {}: batch of bricks (0,0,5) to (0,0,5)", at)));
  }
}

TEST_CASE("a stream can be read through a pipe", "[quick][io]") {
  const StreamHeader header = random_header(5);
  const Bytes bytes = written(header, random_bricks(header, 5, 60));
  const StreamFolder file;
  std::ofstream(file.path(), std::ios::binary).write(reinterpret_cast<const char*>(bytes.data()), long(bytes.size()));
  FILE* pipe = ::popen(("cat " + file.path()).c_str(), "r");
  REQUIRE(pipe != nullptr);
  {
    BrickReader reader(fmt::format("/proc/self/fd/{}", ::fileno(pipe)));
    Brick b;
    while (reader.read(b)) {
    }
    CHECK(reader.totals().checksum() == read_back(bytes).totals.checksum());
  }
  ::pclose(pipe);
}
