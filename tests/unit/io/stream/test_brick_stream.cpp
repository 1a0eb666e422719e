#include <stdio.h>
#include <stdlib.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <random>
#include <sstream>

#include "io/stream/brick_stream.h"
#include "lib/core/error.h"
#include "lib/core/parallel.h"
#include "tests/catch.h"
#include "tests/reference/brick_stream.h"
#include "tests/unit/io/stream/stream_files.h"

using namespace bp;
using namespace stream_files;

namespace {

std::vector<Brick> bricks_of(const reference::StreamFile& file, int slab_axis) {
  std::vector<Brick> bricks;
  for (const auto& [key, voxels] : file.bricks) {
    const auto [layer, x, y, z] = key;
    Brick b;
    b.coord = {x, y, z};
    b.layer = Layer(layer);
    for (std::size_t i = 0; i < voxels.size(); ++i) b.bits[i / 64] |= std::uint64_t(voxels[i]) << (i % 64);
    b.fill = classify(b.bits);
    bricks.push_back(b);
  }
  std::sort(bricks.begin(), bricks.end(), [&](auto& a, auto& b) { return slab_order(slab_axis, a, b); });
  return bricks;
}

Bytes document_example() {
  std::ifstream doc(BP_SOURCE_DIR "/docs/brick-stream.md");
  REQUIRE(doc);
  std::string line;
  while (std::getline(doc, line) && line.find("## 12.") != 0) {
  }
  while (std::getline(doc, line) && line != "```") {
  }
  Bytes bytes;
  while (std::getline(doc, line) && line != "```") {
    std::istringstream words(line);
    std::string offset;
    words >> offset;
    CHECK(std::stoul(offset, nullptr, 16) == bytes.size());
    std::string word;
    while (words >> word) bytes.push_back(static_cast<unsigned char>(std::stoul(word, nullptr, 16)));
  }
  return bytes;
}

}  // namespace

TEST_CASE("random streams come back as they were written", "[quick][io]") {
  const std::uint32_t seed = GENERATE(range(0u, 24u));
  CAPTURE(seed);
  const StreamHeader header = random_header(seed);
  const std::vector<Brick> bricks = random_bricks(header, seed, int(seed * 7 % 100));
  const Content content = read_back(written(header, bricks, int(seed % 4)));
  CHECK(content.header == header);
  CHECK(same(content.bricks, bricks));
  std::uint64_t full = 0;
  for (const Brick& b : bricks) full += b.fill == BrickFill::full;
  CHECK(content.totals.layers[0].bricks + content.totals.layers[1].bricks == bricks.size());
  CHECK(content.totals.layers[0].full + content.totals.layers[1].full == full);
}

TEST_CASE("a reader written from the document alone reads the same", "[quick][io]") {
  const std::uint32_t seed = GENERATE(range(100u, 106u));
  CAPTURE(seed);
  const StreamHeader h = random_header(seed);
  const std::vector<Brick> bricks = random_bricks(h, seed, 40);
  const Bytes bytes = written(h, bricks);
  const reference::StreamFile file = reference::read_stream(bytes);
  CHECK(same(bricks_of(file, h.slab_axis), bricks));
  CHECK(file.checksum == read_back(bytes).totals.checksum());
  CHECK(file.voxel == h.frame.voxel);
  CHECK(file.origin == h.frame.origin);
  CHECK(file.up == int(h.frame.up));
  CHECK(file.slab_axis == h.slab_axis);
  CHECK(file.fill == int(h.fill));
  CHECK(file.element == (h.has_closing ? int(h.element) : 0));
  CHECK(file.has_closing == h.has_closing);
  CHECK(file.scale == (h.has_closing ? to_json(h.scale) : ""));
  CHECK(file.scene.empty() == h.scene.files.empty());
  if (!file.scene.empty()) CHECK(file.scene.find(h.scene.hash) != std::string::npos);
  CHECK(file.bounds[4] == h.bounds.max[1]);
  CHECK(file.box ==
        std::array{h.bricks.min.x, h.bricks.min.y, h.bricks.min.z, h.bricks.max.x, h.bricks.max.y, h.bricks.max.z});
}

TEST_CASE("the stream printed in the document is the one it describes", "[quick][io]") {
  const Bytes bytes = document_example();
  const Content content = read_back(bytes);
  CHECK(content.header == small_header());
  CHECK(same(content.bricks, small_bricks()));
  CHECK(reference::read_stream(bytes).checksum == content.totals.checksum());
}

TEST_CASE("a stream tells no scene files if one cannot be told", "[quick][io]") {
  StreamHeader header = small_header();
  header.scene = {{{"scene.ply", 3}, {"name", 4}}, "", 12, std::string(32, 'a')};
  CHECK(read_back(written(header, small_bricks())).header == header);
  header.scene.files[1].name = "latin \xe9.ply";
  CHECK(read_back(written(header, small_bricks())).header.scene == SceneFiles{});
  header.scene.files[1].name = "two\nlines.ply";
  CHECK(read_back(written(header, small_bricks())).header.scene == SceneFiles{});
  header.scene.files[1].name = std::string(1 << 20, 'n');
  CHECK(read_back(written(header, small_bricks())).header.scene == SceneFiles{});
}

TEST_CASE("a stream without bricks is legal", "[quick][io]") {
  StreamHeader header;  // no scene, an empty box
  const Content content = read_back(written(header, {}));
  CHECK(content.header == header);
  CHECK(content.bricks.empty());
  CHECK(content.totals.checksum() == std::string(32, '0'));
  CHECK(reference::read_stream(written(header, {})).bricks.empty());
}

TEST_CASE("the bytes do not depend on the number of threads", "[quick][io]") {
  StreamHeader header = random_header(7);
  header.bricks = {{-2, -2, -2}, {4, 4, 6}};
  header.slab_axis = 2;
  fit_bounds(header);
  const std::vector<Brick> bricks = random_bricks(header, 7, 300);
  Bytes one;
  {
    const ThreadLimit limit(1);
    one = written(header, bricks);
    CHECK(same(read_back(one).bricks, bricks));
  }
  for (const int threads : {2, 3, 8}) {
    const ThreadLimit limit(threads);
    CHECK(written(header, bricks) == one);
    CHECK(same(read_back(one).bricks, bricks));
  }
}

TEST_CASE("more full bricks than fit a batch are cut into several", "[quick][io]") {
  StreamHeader header = small_header();
  header.bricks = {{0, 0, 0}, {100, 100, 1}};
  Brick b;
  b.bits.fill(~std::uint64_t(0));
  b.fill = BrickFill::full;
  std::vector<Brick> bricks;
  StreamFolder file;
  OutputFile out(file.path(), false);
  BrickWriter writer(out, header);
  for (b.coord.y = 0; b.coord.y < 100; ++b.coord.y) {
    for (b.coord.x = 0; b.coord.x < 100; ++b.coord.x) writer.write(b);
  }
  writer.finish();
  out.commit();
  BrickReader reader(file.path());
  int count = 0;
  Brick got;
  while (reader.read(got)) count += got.fill == BrickFill::full && got.coord == BrickCoord{count % 100, count / 100, 0};
  CHECK(count == 10000);
  CHECK(reader.totals() == writer.totals());
  CHECK(reader.totals().layers[0].voxels == std::uint64_t(10000) * 64 * 64 * 64);
}

TEST_CASE("a brick is stored as what it holds, whatever it is called", "[quick][io]") {
  StreamHeader header = small_header();
  header.bricks.max = {3, 1, 1};
  header.slab_axis = 0;
  std::vector<Brick> bricks(3);
  for (int i = 0; i < 3; ++i) {
    bricks[std::size_t(i)].coord.x = i;
    bricks[std::size_t(i)].fill = BrickFill::mixed;
  }
  bricks[1].bits.fill(~std::uint64_t(0));
  bricks[2].bits[5] = 1;
  const Content content = read_back(written(header, bricks));
  REQUIRE(content.bricks.size() == 2);
  CHECK(content.bricks[0].fill == BrickFill::full);
  bricks[1].fill = BrickFill::full;
  bricks[1].bits = {};  // not looked at
  CHECK(read_back(written(header, bricks)).totals.checksum() == content.totals.checksum());
}

namespace {

/// Returns a header with a closing to come, by cubes of one scale.
StreamHeader header_with_field() {
  StreamHeader header = random_header(5);
  header.has_closing = false;
  header.element = StructuringElement::cube;
  header.has_field = true;
  header.scale = {};
  header.scale.base = 3 * header.frame.voxel;
  return header;
}

}  // namespace

TEST_CASE("a scale field for a closing to come survives the stream, and needs its flag", "[quick][io]") {
  StreamHeader header = header_with_field();
  header.scale.rules = {box_rule({0, 0, 0}, {1, 2, 3}, header.frame.voxel)};
  CHECK(read_back(written(header, {})).header == header);
  header.has_field = false;
  const StreamHeader without = read_back(written(header, {})).header;
  CHECK_FALSE(without.has_field);
  CHECK(without.scale == ScaleField{});
}

TEST_CASE("an orientation survives the stream, and needs a closing by cubes", "[quick][io][oriented]") {
  StreamHeader header = header_with_field();
  header.orientation = {16, {-1, 0, 2}, {2, 1, 3}, {{}, {16000, 3000, -1, 200}}, {0, 1, 1, 0, 0, 1}};
  CHECK(read_back(written(header, {})).header == header);
  CHECK(reference::read_stream(written(header, {})).bricks.empty());
  header.scene = {};
  CHECK(read_back(written(header, {})).header == header);
  CHECK(reference::read_stream(written(header, {})).bricks.empty());
  header.has_field = false;
  header.has_closing = true;
  CHECK(read_back(written(header, {})).header == header);
  header.has_closing = false;
  CHECK(read_back(written(header, {})).header.orientation.empty());
  header.has_field = true;
  header.orientation.cells[3] = 2;
  StreamFolder file;
  OutputFile out(file.path(), false);
  CHECK_THROWS_WITH(BrickWriter(out, header), ContainsSubstring("names a rotation that is not there"));
}

TEST_CASE("the checksum tells content from everything else", "[quick][io]") {
  StreamHeader header = random_header(3);
  header.bricks = {{0, 0, 0}, {3, 3, 3}};
  header.bounds = {};
  header.slab_axis = 2;
  header.has_closing = true;
  header.scale.base = header.frame.voxel;
  std::vector<Brick> bricks = random_bricks(header, 3, 40);
  const auto sum = [&] { return read_back(written(header, bricks)).totals.checksum(); };
  const std::string before = sum();
  header.slab_axis = 0;  // another order
  std::sort(bricks.begin(), bricks.end(), [](auto& a, auto& b) { return slab_order(0, a, b); });
  header.provenance = {{"other", "9", "", ""}};
  header.frame.voxel *= 2;
  CHECK(sum() == before);
  CHECK(read_back(written(header, bricks, 9)).totals.checksum() == before);
  const Brick kept = bricks[5];
  bricks[5].bits[77] ^= 4;
  bricks[5].fill = BrickFill::mixed;
  CHECK(sum() != before);
  bricks[5] = kept;
  const Brick last = bricks.back();
  bricks.pop_back();
  CHECK(sum() != before);
  bricks.push_back(last);
  CHECK(sum() == before);
  // The same voxels in the other layer, or in another brick, are other content.
  std::vector<Brick> one{kept};
  one[0].layer = Layer::solid;
  const std::string solid = read_back(written(header, one)).totals.checksum();
  one[0].layer = Layer::closing;
  const std::string closing = read_back(written(header, one)).totals.checksum();
  one[0].coord.x = (one[0].coord.x + 1) % 3;
  CHECK(solid != closing);
  CHECK(closing != read_back(written(header, one)).totals.checksum());
}

TEST_CASE("zstd accepts a stream", "[quick][io]") {
  if (std::system("zstd --version >/dev/null 2>&1") != 0) {
    WARN("zstd is not installed");
    return;
  }
  const StreamHeader header = random_header(11);
  const auto accepts = [](const Bytes& bytes) {
    FILE* zstd = ::popen("zstd -qt 2>/dev/null", "w");
    REQUIRE(zstd != nullptr);
    (void)std::fwrite(bytes.data(), 1, bytes.size(), zstd);
    return ::pclose(zstd) == 0;
  };
  Bytes bytes = written(header, random_bricks(header, 11, 50));
  CHECK(accepts(bytes));
  bytes[bytes.size() / 3] ^= 1;  // within a batch
  CHECK_FALSE(accepts(bytes));
}

TEST_CASE("a writer refuses bricks that its reader would refuse", "[quick][io]") {
  StreamFolder file;
  OutputFile out(file.path(), false);
  StreamHeader header = small_header();
  header.bricks.max = {4, 4, 4};
  BrickWriter writer(out, header);
  Brick b = small_bricks()[0];
  const auto code = [&] {
    try {
      writer.write(b);
    } catch (const Error& e) {
      return int(e.code());
    }
    return -1;
  };
  const int failed = int(ErrorCode::failed);
  b.coord = {1, 1, 1};
  CHECK(code() == -1);
  CHECK(code() == failed);  // twice
  b.coord = {0, 1, 1};
  CHECK(code() == failed);  // earlier
  b.coord = {4, 1, 1};
  CHECK(code() == failed);  // outside
  b.coord = {2, 1, 1};
  b.layer = Layer::closing;
  CHECK(code() == failed);  // not in the header
  writer.finish();
  b.layer = Layer::solid;
  CHECK(code() == failed);  // after the end
}

TEST_CASE("a header beyond the format is refused by the writer", "[quick][io]") {
  struct Fault {
    const char* says;
    std::function<void(StreamHeader&)> make;
  };
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::vector<Fault> faults{
      {"voxel size", [](StreamHeader& h) { h.frame.voxel = 0; }},
      {"voxel size", [](StreamHeader& h) { h.frame.voxel = kInfinity; }},
      {"voxel size", [](StreamHeader& h) { h.frame.voxel = -0.5; }},
      {"voxel size", [](StreamHeader& h) { h.frame.voxel = std::nan(""); }},
      {"voxel size", [](StreamHeader& h) { h.frame.voxel = 0x1p-101; }},
      {"voxel size", [](StreamHeader& h) { h.frame.voxel = 1e100; }},
      {"origin", [](StreamHeader& h) { h.frame.origin[1] = (std::int64_t(1) << 47) + 1; }},
      {"exact", [](StreamHeader& h) { h.frame.origin[2] = -(std::int64_t(1) << 47); }},
      {"exact", [](StreamHeader& h) { h.frame.voxel = 0.1; }},
      {"brick box", [](StreamHeader& h) { h.bricks.max.z = 1 << 25; }},
      {"brick box", [](StreamHeader& h) { h.bricks.min.x = 2; }},
      {"brick box", [](StreamHeader& h) { h.bricks.min.y = -(1 << 25); }},
      {"brick box", [](StreamHeader& h) { h.bricks.min.y = -(1 << 24), h.bricks.max.y = 1 << 24; }},
      {"bounds", [](StreamHeader& h) { h.bounds.min[2] = 6; }},
      {"bounds", [](StreamHeader& h) { h.bounds.max[0] = kInfinity; }},
      {"beyond the brick box", [](StreamHeader& h) { h.bounds.max[0] = 1e9; }},
      {"beyond the brick box", [](StreamHeader& h) { h.frame.origin[0] = std::int64_t(1) << 40; }},
      {"slab axis", [](StreamHeader& h) { h.slab_axis = 3; }},
      {"provenance", [](StreamHeader& h) { h.provenance[0].options.assign(1 << 20, 'x'); }},
      {"control characters", [](StreamHeader& h) { h.provenance[0].options = "a\nelement vertex 9"; }},
  };
  for (const Fault& fault : faults) {
    StreamHeader h = small_header();
    fault.make(h);
    StreamFolder file;
    OutputFile out(file.path(), false);
    CHECK_THROWS_WITH(BrickWriter(out, h), ContainsSubstring(fault.says));
  }
}
