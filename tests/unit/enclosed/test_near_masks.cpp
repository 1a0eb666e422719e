#include "lib/core/parallel.h"
#include "lib/enclosed/near_masks.h"
#include "tests/catch.h"
#include "tests/support/memory_shelf.h"
#include "tests/support/random_lattice.h"

namespace bp::test {

namespace {

/// A voxel in each of `n` bricks along each axis, which are `apart` bricks apart.
void add_dots(MemoryShelf& shelf, std::int32_t n, std::int32_t apart) {
  for (std::int32_t i = 0; i < n * n * n; ++i) {
    BrickBits bits{};
    bits[std::size_t(20 * kBrickEdge + 30)] = std::uint64_t(1) << 40;  // 40, 30, 20
    shelf.put({i % n * apart, i / n % n * apart, i / (n * n) * apart}, BrickFill::mixed, bits);
  }
}

/// From a point to the nearest of the dots.
double distance_to_dots(const LatticeCoord& p, std::int32_t n, std::int32_t apart) {
  const std::int64_t brick = std::int64_t(kBrickEdge) * kLatticePerVoxel, first[3] = {40, 30, 20};
  double squared = 0;
  for (int a = 0; a < 3; ++a) {
    double least = 1e300;
    for (std::int32_t i = 0; i < n; ++i) {
      const std::int64_t low = i * apart * brick + first[a] * kLatticePerVoxel;
      least = std::min(least, double(std::max({std::int64_t(0), low - p[a], p[a] - low - kLatticePerVoxel})));
    }
    squared += least * least;
  }
  return std::sqrt(squared);
}

}  // namespace

TEST_CASE("a mask errs by two of its voxels at most, to either side, also where these are larger", "[quick][meshing]") {
  // Distances in voxels; the mask's voxels; and whether they are larger because of the distance or of the bricks.
  struct Case {
    double distance;
    std::int64_t edge;
    std::int32_t dots;
  };
  const auto [distance, edge, dots] = GENERATE(Case{1, 1, 2}, Case{3, 1, 2}, Case{15, 1, 2}, Case{17, 2, 2},
                                               Case{40, 4, 2}, Case{3, 2, 9}, Case{40, 4, 9});
  CAPTURE(distance, edge, dots);
  MemoryShelf shelf;
  add_dots(shelf, dots, 2);
  const NearMasks masks(shelf);
  const double reach = distance * kLatticePerVoxel, unsure = 2 * std::sqrt(3.0) * double(edge) * kLatticePerVoxel;
  RandomLattice random(3);
  const std::int64_t size = (dots * 2 + 1) * std::int64_t(kBrickEdge) * kLatticePerVoxel;
  int near = 0, far = 0;
  for (int i = 0; i < 4000; ++i) {
    LatticeCoord p = random.point(0, size);
    if (i % 2 == 0) {  // about a dot
      const LatticeCoord dot = LatticeCoord{40, 30, 20} * kLatticePerVoxel;
      const auto most = std::int64_t(reach + 2 * unsure);
      p = dot + random.point(-most, most);
    }
    std::array<LatticeCoord, 3> corners;
    double farthest = 0;
    for (LatticeCoord& c : corners) {
      c = p + random.point(0, 64);
      farthest = std::max(farthest, distance_to_dots(c, dots, 2));
    }
    const bool answer = masks.is_near(std::array<NewFace, 1>{{{{}, corners}}}, reach);
    if (farthest + 64 < reach - unsure) CHECK(answer);
    if (farthest > reach + unsure) CHECK_FALSE(answer);
    const bool edge = masks.is_near(corners[0], corners[1], reach);
    if (farthest + 64 < reach - unsure) CHECK(edge);
    if (distance_to_dots(corners[0], dots, 2) > reach + unsure) CHECK_FALSE(edge);
    near += answer;
    far += farthest > reach + unsure;
  }
  CHECK(near > 0);
  CHECK(far > 1000);
  CHECK(masks.bytes() > 0);
}

TEST_CASE("masks that several threads ask for at the same time are made once, with the same answers",
          "[quick][meshing]") {
  constexpr int kDistances = 3, kQuestions = 300;
  MemoryShelf shelf;
  add_dots(shelf, 2, 2);
  const NearMasks together(shelf), prepared(shelf);
  const auto distance = [](std::int64_t i) { return double(3 + 4 * (i % kDistances)) * kLatticePerVoxel; };
  const auto ask = [&](const NearMasks& masks, std::int64_t i) {
    const LatticeCoord p = LatticeCoord{40 + i % 16, 30, 20} * kLatticePerVoxel;
    return masks.is_near(std::array<NewFace, 1>{{{{}, {p, p, p}}}}, distance(i));
  };
  for (int i = 0; i < kDistances; ++i) prepared.prepare(distance(i));
  const std::uint64_t bytes = prepared.bytes();
  std::vector<char> answers(kQuestions);
  parallel_for(kQuestions, [&](std::int64_t i) { answers[std::size_t(i)] = ask(together, i); });
  int near = 0;
  for (std::int64_t i = 0; i < kQuestions; ++i) {
    CHECK(bool(answers[std::size_t(i)]) == ask(prepared, i));
    near += answers[std::size_t(i)];
  }
  CHECK(near > 0);
  CHECK(near < kQuestions);
  CHECK(together.bytes() == bytes);
  CHECK(prepared.bytes() == bytes);
}

}  // namespace bp::test
