// Mutants of valid inputs: whatever is changed, no verdict says that they still hold. Seeded.
#include <random>

#include "lib/check/tile_cover.h"
#include "tests/catch.h"
#include "tests/unit/check/meshes.h"

using namespace bp;
using namespace bp::test;

namespace {

/// Breaks a closed mesh around a cube of edge 2 in the way `kind`, of 7.
IndexedMesh mutant(IndexedMesh m, int kind, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
  const std::size_t t = below(m.triangles.size()), k = below(3);
  const std::array<std::uint32_t, 3> face = m.triangles[t];
  switch (kind) {
    case 0:
      m.triangles.erase(m.triangles.begin() + std::ptrdiff_t(t));
      break;
    case 1:
      std::swap(m.triangles[t][0], m.triangles[t][1]);
      break;
    case 2:
      m.triangles.push_back({face[k], face[(k + 1) % 3], face[(k + 2) % 3]});
      break;
    case 3:  // of no area
      m.vertices[face[k]] = m.vertices[face[(k + 1) % 3]];
      break;
    case 4:  // another vertex, or one that does not exist
      m.triangles[t][k] =
          (face[k] + 1 + std::uint32_t(below(m.vertices.size()))) % (std::uint32_t(m.vertices.size()) + 2);
      break;
    case 5:  // through the cube
      for (double& x : m.vertices[face[k]]) x *= -0.5;
      break;
    default:
      m.bad_faces = 1;
  }
  return m;
}

struct LeafScene {
  std::vector<TriangleD> triangles = triangles_of(box({2, 2, 2}, {6, 3, 3}));
  static constexpr double kError = 1e-5;

  /// Returns whether a leaf that shows these triangles passes as the scene itself.
  [[nodiscard]] bool is_shown_by(const std::vector<TriangleD>& shown) const {
    const Bounds3d cell{{0, 0, 0}, {16, 16, 16}};
    IndexedMesh content;
    for (const TriangleD& t : shown) {
      const auto n = std::uint32_t(content.vertices.size());
      content.vertices.insert(content.vertices.end(), t.begin(), t.end());
      content.triangles.push_back({n, n + 1, n + 2});
    }
    const IndexedMesh around = box({1, 1, 1}, {15, 4, 4});
    const std::vector<CoverTile> tiles{{"root", "r", around.triangles.size(), cell, {1}, {}},
                                       {"root.0", "a", content.triangles.size(), cell, {}, kError}};
    VectorSource source(triangles);
    return check_cover(
               tiles, [&](std::size_t i) { return i == 0 ? around : content; }, source)
        .findings.empty();
  }
};

}  // namespace

TEST_CASE("no mutant of a proxy holds", "[property][check]") {
  std::mt19937 random(3975);
  const IndexedMesh around = sphere(2, 3);
  const std::vector<TriangleD> scene = triangles_of(cube(1));
  REQUIRE(check(around, scene).holds());
  for (int i = 0; i < 700; ++i) {
    CAPTURE(i);
    const CheckReport r = check(mutant(around, i % 7, random), scene);
    CHECK(r.answer() == Answer::refuted);
  }
}

TEST_CASE("no mutant of a leaf is taken for the scene, and rounding does no harm", "[property][check][tileset]") {
  std::mt19937 random(100);
  std::uniform_real_distribution<double> unit(-1, 1);
  const LeafScene scene;
  REQUIRE(scene.is_shown_by(scene.triangles));
  for (int i = 0; i < 200; ++i) {
    CAPTURE(i);
    std::vector<TriangleD> shown = scene.triangles;
    TriangleD& t = shown[std::size_t(random() % shown.size())];
    Vec3d& p = t[random() % 3];
    const double by = 1e-3 + std::abs(unit(random));
    if (i % 5 == 0) shown.erase(shown.begin() + std::ptrdiff_t(random() % shown.size()));
    if (i % 5 == 1) std::swap(t[0], t[1]);
    if (i % 5 == 2) p[random() % 3] += unit(random) < 0 ? by : -by;
    if (i % 5 == 3) shown.push_back({{{3, 2 + by, 2.5}, {4, 2 + by, 2.5}, {3, 2 + by, 2.75}}});
    if (i % 5 == 4) {
      for (TriangleD& all : shown)
        for (Vec3d& q : all)
          for (double& x : q) x += LeafScene::kError / 2 * unit(random);
    }
    CHECK(scene.is_shown_by(shown) == (i % 5 == 4));
  }
}

TEST_CASE("margins are decided on either side of the least distance", "[property][check]") {
  std::mt19937 random(780);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 200; ++i) {
    const double far = i % 4 == 0 ? 0 : std::ldexp(1.0, i % 20),
                 gap = std::ldexp(1 + unit(random), -int(random() % 10));
    const Vec3d c{far, -far, far};
    const std::vector<TriangleD> scene = triangles_of(cube(1, c));
    const IndexedMesh proxy = cube(1 + gap, c);
    const double rounding = 1e-12 * (1 + far);
    CheckOptions options;
    options.distances = false;
    const auto answer = [&](double margin) {
      options.margin_world = margin;
      return check(proxy, scene, options).answer();
    };
    CAPTURE(i, far, gap);
    CHECK(answer(gap - rounding) == Answer::proven);
    CHECK(answer(gap + rounding) == Answer::refuted);
    CHECK(answer(gap * 0.5) == Answer::proven);
    CHECK(answer(gap * 2) == Answer::refuted);
  }
}
