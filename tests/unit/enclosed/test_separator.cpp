#include <random>

#include "lib/enclosed/detail/separator.h"
#include "lib/exact/predicates.h"
#include "tests/catch.h"

namespace bp::test {

namespace {

/// A layer that holds one cube, with its low corner at `low`.
struct Layer {
  std::uint64_t bits;
  LatticeCoord corner;
};
Layer layer_of(const LatticeCoord& low, std::int64_t edge, std::uint64_t place) {
  const auto x = std::int64_t(place % 8), y = std::int64_t(place / 8 % 8);
  return {std::uint64_t(1) << (8 * y + x), low - LatticeCoord{x * edge, y * edge, 0}};
}

}  // namespace

TEST_CASE("cubes that hold a corner of a tetrahedron, barely, are not told from it, however large it is",
          "[quick][meshing]") {
  const int bits = GENERATE(4, 9, 14, 20, 29);
  const std::int64_t offset = GENERATE(std::int64_t(0), std::int64_t(1) << 38);
  CAPTURE(bits, offset);
  std::mt19937_64 random{std::uint64_t(bits)};
  const auto pick = [&](std::int64_t below) { return std::int64_t(random() % std::uint64_t(below)); };
  std::size_t wrong = 0, cubes = 0;
  for (int i = 0; i < 2000; ++i) {
    Tetrahedron t;
    for (LatticeCoord& p : t) {
      for (int k = 0; k < 3; ++k) p[k] = offset + pick(std::int64_t(1) << bits);
    }
    if (i % 3 == 0) {  // next to flat
      for (int k = 0; k < 3; ++k) t[3][k] = (t[0][k] + t[1][k] + t[2][k]) / 3 + pick(3) - 1;
    }
    if (orient3d(t[0], t[1], t[2], t[3]) == 0) continue;
    Separator separator(t);
    for (const LatticeCoord& p : t) {
      for (const std::int64_t voxels : {1, 8, 64}) {
        const std::int64_t edge = voxels * kLatticePerVoxel;
        LatticeCoord low = p;  // the corner lies a unit inside of three sides of the cube, or deeper
        for (int k = 0; k < 3; ++k) low[k] -= pick(2) == 0 ? 1 : pick(2) == 0 ? edge - 1 : 1 + pick(edge - 1);
        const Layer layer = layer_of(low, edge, random() % 64);
        wrong += separator.left(layer.bits, layer.corner, edge) != layer.bits;
        wrong += separator.separates(low, edge);
        ++cubes;
      }
    }
  }
  CHECK(cubes > 5000);
  CHECK(wrong == 0);
}

TEST_CASE("what is told apart in floats is apart, and that is most of what is", "[quick][meshing]") {
  const int bits = GENERATE(8, 12, 24);
  CAPTURE(bits);
  std::mt19937_64 random(7);
  const auto pick = [&](std::int64_t below) { return std::int64_t(random() % std::uint64_t(below)); };
  const std::int64_t edge = kLatticePerVoxel;
  std::size_t told = 0, apart = 0, wrong = 0;
  for (int i = 0; i < 20000; ++i) {
    Tetrahedron t;
    for (LatticeCoord& p : t)
      p = {pick(std::int64_t(1) << bits), pick(std::int64_t(1) << bits), pick(std::int64_t(1) << bits)};
    Separator separator(t);
    LatticeCoord low;
    for (int k = 0; k < 3; ++k)
      low[k] = separator.box().min[k] - edge + 1 + pick(separator.box().max[k] - separator.box().min[k] + edge - 1);
    const Layer layer = layer_of(low, edge, random() % 64);
    const bool is_told = separator.left(layer.bits, layer.corner, edge) == 0, is_apart = separator.separates(low, edge);
    told += is_told;
    apart += is_apart;
    wrong += is_told && !is_apart;
  }
  CAPTURE(told, apart);
  CHECK(wrong == 0);
  CHECK(apart > 1000);
  CHECK(10 * told > 7 * apart);
}

}  // namespace bp::test
