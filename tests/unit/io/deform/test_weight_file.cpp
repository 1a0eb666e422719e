#include <random>

#include "io/deform/weight_file.h"
#include "tests/support/cages.h"
#include "tests/unit/io/scene/scene_files.h"

using namespace bp;
using namespace bp::test;

namespace {

WeightBlock random_block(std::size_t points, std::size_t columns, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  WeightBlock b;
  b.points = points, b.columns = columns;
  b.bits.assign(points, WeightBlock::kBits);
  b.bits[points / 2] = 3;
  for (std::size_t i = 0; i < points * columns; ++i) b.units.push_back(std::int32_t(random() >> (random() % 64)));
  return b;
}

struct Written {
  WeightHeader header{"scene.obj", 1234, sphere_cage(4, 5)};
  std::vector<WeightBlock> blocks;
  WeightTotals totals{0, 3, ResultKey{{5, 6}}};

  Written() {
    for (const std::size_t points : {4096, 4096, 7}) {
      blocks.push_back(random_block(points, header.cage.vertices.size(), points));
      totals.points += points;
    }
  }
  void write(const std::string& path) const {
    OutputFile out(path, true);
    WeightWriter writer(out, header);
    for (const WeightBlock& b : blocks) {
      PackedWeights packed;
      pack_weights(b, packed);
      writer.write(packed);
    }
    writer.finish(totals);
    out.commit();
  }
};

/// Reads to the end; the number of blocks.
std::size_t read_to_end(const std::string& path) {
  WeightReader reader(path);
  PackedWeights packed;
  WeightBlock block;
  std::size_t blocks = 0;
  for (; reader.next(packed); ++blocks) reader.unpack(packed, block);
  return blocks;
}

}  // namespace

TEST_CASE("a file of weights names its coordinates, and those it does not know are refused", "[io][deform][quick]") {
  const TempDir dir;
  WeightHeader header{"scene.obj", 1234, sphere_cage(4, 5), CoordinateKind::green};
  const std::size_t columns = columns_of(header.kind, header.cage);
  CHECK(columns == header.cage.vertices.size() + header.cage.triangles.size());
  const auto write = [&](const std::string& path) {
    OutputFile out(path, true);
    WeightWriter writer(out, header);
    PackedWeights packed;
    pack_weights(random_block(5, columns, 1), packed);
    writer.write(packed);
    writer.finish({5, 0, ResultKey{{5, 6}}});
    out.commit();
  };
  write(dir.path("a.bpw"));
  WeightReader reader(dir.path("a.bpw"));
  CHECK((reader.header().kind == CoordinateKind::green));
  CHECK(reader.points_declared() == 5);
  CHECK(read_to_end(dir.path("a.bpw")) == 1);
  header.kind = CoordinateKind(9);
  write(dir.path("b.bpw"));
  CHECK_THROWS_WITH(WeightReader(dir.path("b.bpw")), ContainsSubstring("coordinates of kind 9"));
}

TEST_CASE("a file of weights gives back what was written", "[io][deform][quick]") {
  const TempDir dir;
  const Written written;
  written.write(dir.path("w.bpw"));
  WeightReader reader(dir.path("w.bpw"));
  CHECK(reader.header().scene == "scene.obj");
  CHECK(reader.header().scene_bytes == 1234);
  CHECK(reader.header().cage.vertices == written.header.cage.vertices);
  CHECK(reader.header().cage.triangles == written.header.cage.triangles);
  PackedWeights packed;
  for (const WeightBlock& expected : written.blocks) {
    REQUIRE(reader.next(packed));
    WeightBlock block;
    reader.unpack(packed, block);
    CHECK(block.bits == expected.bits);
    CHECK(block.units == expected.units);
  }
  CHECK(!reader.next(packed));
  CHECK(reader.totals().points == written.totals.points);
  CHECK(reader.totals().outside == 3);
  CHECK(reader.totals().hash == written.totals.hash);
}

TEST_CASE("a file of weights that is cut off or damaged is an error", "[io][deform][quick]") {
  const TempDir dir;
  Written small;
  small.blocks.erase(small.blocks.begin(), small.blocks.begin() + 2);
  small.totals.points = 7;
  small.write(dir.path("w.bpw"));
  const std::string good = bytes_of_file(dir.path("w.bpw"));
  CHECK(read_to_end(dir.path("w.bpw")) == 1);
  std::string said;
  const auto refused = [&](const std::string& bytes) {
    try {
      (void)read_to_end(dir.file("bad.bpw", bytes));
      FAIL("is read to its end");
    } catch (const Error& e) {
      said += std::string(e.what()) + "\n";
    }
  };
  for (std::size_t n = 0; n < good.size(); n += 1 + good.size() / 200) refused(good.substr(0, n));
  for (std::size_t i = 0; i < good.size(); i += 1 + good.size() / 400) {
    std::string bad = good;
    bad[i] = char(bad[i] ^ (1 << (i % 8)));
    refused(bad);
  }
  refused(good + "x");
  CHECK_THAT(said, ContainsSubstring("a block cannot be decompressed; bind the scene again"));
  CHECK_THROWS_WITH(read_to_end(dir.file("x.bpw", "v 0 0 0\n")), Contains("is no file of weights"));
}
