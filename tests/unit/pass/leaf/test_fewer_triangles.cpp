#include <algorithm>
#include <set>
#include <utility>

#include "lib/core/vec3.h"
#include "lib/pass/leaf/fewer_triangles.h"
#include "tests/catch.h"

using namespace bp;

namespace {

constexpr std::int32_t kStep = 1000;

/// A grid of squares in the plane z = 0, whose height is `height(x, y)`; places in images are x and y over 10.
template <class Height>
LeafPart grid(std::int32_t from, std::int32_t to, std::int32_t rows, std::uint32_t material, const Height& height) {
  LeafPart part;
  part.material = material;
  const auto columns = std::uint32_t(to - from + 1);
  for (std::int32_t y = 0; y <= rows; ++y) {
    for (std::int32_t x = from; x <= to; ++x) {
      LeafVertex v;
      v.at = {x * kStep, y * kStep, height(x, y)};
      v.normal = {0, 0, 1};
      v.uv = {float(x) / 10, float(y) / 10};
      part.vertices.push_back(v);
    }
  }
  for (std::uint32_t y = 0; y < std::uint32_t(rows); ++y) {
    for (std::uint32_t x = 0; x + 1 < columns; ++x) {
      const std::uint32_t a = y * columns + x, b = a + 1, c = a + columns, d = c + 1;
      part.triangles.push_back({a, b, d});
      part.triangles.push_back({a, d, c});
    }
  }
  return part;
}

std::int32_t flat(std::int32_t, std::int32_t) {
  return 0;
}

SceneLeaf leaf_of(std::vector<LeafPart> parts) {
  SceneLeaf leaf;
  leaf.unit = 1;
  leaf.parts = std::move(parts);
  return leaf;
}

SceneLeaf fewer(const SceneLeaf& leaf, std::uint64_t triangles) {
  const std::uint64_t most[] = {triangles};
  return with_fewer_triangles(leaf, most).front();
}

Vec3d point(const LeafVertex& v) {
  return {double(v.at[0]), double(v.at[1]), double(v.at[2])};
}

double area(const LeafPart& part) {
  double sum = 0;
  for (const auto& t : part.triangles)
    sum += area_of(TriangleD{point(part.vertices[t[0]]), point(part.vertices[t[1]]), point(part.vertices[t[2]])});
  return sum;
}

/// A closed box of 12 triangles, from a corner on.
void add_box(LeafPart& part, std::array<std::int32_t, 3> from, std::array<std::int32_t, 3> size) {
  const auto first = std::uint32_t(part.vertices.size());
  for (int i = 0; i < 8; ++i) {
    LeafVertex v;
    for (std::size_t k = 0; k < 3; ++k) v.at[k] = from[k] + (i >> k & 1) * size[k];
    part.vertices.push_back(v);
  }
  constexpr std::array<std::array<std::uint32_t, 4>, 6> kSides{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& s : kSides) {
    part.triangles.push_back({first + s[0], first + s[1], first + s[2]});
    part.triangles.push_back({first + s[0], first + s[2], first + s[3]});
  }
}

}  // namespace

TEST_CASE("what is flat needs few triangles, and keeps its places in images", "[quick]") {
  const SceneLeaf leaf = leaf_of({grid(0, 10, 10, 0, flat)});
  const SceneLeaf few = fewer(leaf, 2);
  REQUIRE(few.triangles() == 2);
  CHECK(area(few.parts[0]) == area(leaf.parts[0]));
  for (const LeafVertex& v : few.parts[0].vertices) {
    CHECK(v.uv[0] == Approx(v.at[0] / (10.0 * kStep)));
    CHECK(v.uv[1] == Approx(v.at[1] / (10.0 * kStep)));
  }
}

TEST_CASE("materials keep their places", "[quick]") {
  const SceneLeaf leaf = leaf_of({grid(0, 6, 10, 0, flat), grid(6, 10, 10, 1, flat)});
  const SceneLeaf few = fewer(leaf, 4);
  REQUIRE(few.triangles() == 4);
  REQUIRE(few.parts.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(few.parts[i].material == i);
    CHECK(area(few.parts[i]) == area(leaf.parts[i]));
  }
}

TEST_CASE("a ridge is kept while the planes beside it become large", "[quick]") {
  const auto roof = [](std::int32_t x, std::int32_t) { return (5 - std::abs(x - 5)) * kStep; };
  const SceneLeaf few = fewer(leaf_of({grid(0, 10, 10, 0, roof)}), 4);
  REQUIRE(few.triangles() == 4);
  std::int32_t highest = 0;
  for (const LeafVertex& v : few.parts[0].vertices) highest = std::max(highest, v.at[2]);
  CHECK(highest == 5 * kStep);
}

TEST_CASE("a thin board becomes a sheet that is seen from both sides", "[quick]") {
  LeafPart board;
  add_box(board, {0, 0, 0}, {10 * kStep, 6 * kStep, 10});
  const SceneLeaf few = fewer(leaf_of({board}), 2);
  REQUIRE(few.triangles() == 2);
  CHECK(few.parts[0].sides == LeafSides::both);
  CHECK(area(few.parts[0]) == Approx(60.0 * kStep * kStep).epsilon(0.01));
}

TEST_CASE("a thin board whose rim is of another material becomes a sheet", "[quick]") {
  LeafPart faces;
  add_box(faces, {0, 0, 0}, {10 * kStep, 6 * kStep, 10});
  LeafPart rim = faces;
  rim.material = 1;
  rim.triangles.erase(rim.triangles.begin(), rim.triangles.begin() + 4);
  faces.triangles.resize(4);  // the first two sides lie across z
  const SceneLeaf few = fewer(leaf_of({faces, rim}), 2);
  REQUIRE(few.triangles() == 2);
  CHECK(few.parts[0].material == faces.material);
  CHECK(area(few.parts[0]) == Approx(60.0 * kStep * kStep).epsilon(0.01));
}

TEST_CASE("sides of a sheet that look different are shown each from its own side", "[quick]") {
  LeafPart board;
  add_box(board, {0, 0, 0}, {10 * kStep, 6 * kStep, 10});
  const std::vector<LeafVertex> corners = std::exchange(board.vertices, {});
  for (std::size_t i = 0; i < board.triangles.size();
       ++i) {  // the first two sides, and the rim, have images of their own
    for (std::uint32_t& corner : board.triangles[i]) {
      board.vertices.push_back(corners[corner]);
      board.vertices.back().uv = {float(corners[corner].at[0]) / kStep, float(std::min<std::size_t>(i / 2, 2))};
      corner = std::uint32_t(board.vertices.size() - 1);
    }
  }
  const SceneLeaf few = fewer(leaf_of({board}), 4);
  REQUIRE(few.triangles() == 4);
  for (const LeafPart& part : few.parts) CHECK(part.sides == LeafSides::one);
  double sum = 0;
  for (const LeafPart& part : few.parts) sum += area(part);
  CHECK(sum == Approx(120.0 * kStep * kStep).epsilon(0.01));
}

TEST_CASE("boards that touch at a corner are flattened one by one", "[quick]") {
  LeafPart boards;
  add_box(boards, {0, 0, 0}, {10 * kStep, 6 * kStep, 10});
  add_box(boards, {10 * kStep, 6 * kStep, 10}, {10, 6 * kStep, 10 * kStep});
  const SceneLeaf few = fewer(leaf_of({boards}), 4);
  REQUIRE(few.triangles() == 4);
  CHECK(area(few.parts[0]) == Approx(120.0 * kStep * kStep).epsilon(0.02));
}

TEST_CASE("several numbers of triangles are met by one order of collapses", "[quick]") {
  const auto waves = [](std::int32_t x, std::int32_t y) { return (x * x + 3 * y * y) % 7 * 100; };
  const SceneLeaf leaf = leaf_of({grid(0, 20, 20, 0, waves)});
  const std::uint64_t most[] = {800, 300, 50};
  const std::vector<SceneLeaf> all = with_fewer_triangles(leaf, most);
  REQUIRE(all.size() == 3);
  CHECK(all[0].triangles() == 800);  // the leaf itself
  for (std::size_t i = 1; i < 3; ++i) {
    CHECK(all[i].triangles() <= most[i]);
    CHECK(all[i].triangles() + 2 > most[i]);
  }
  const SceneLeaf alone = fewer(leaf, 50);
  CHECK(alone.parts[0].vertices == all[2].parts[0].vertices);
  CHECK(alone.parts[0].triangles == all[2].parts[0].triangles);
}
