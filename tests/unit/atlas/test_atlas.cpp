#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "lib/atlas/atlas.h"
#include "lib/core/error.h"
#include "lib/core/vec3.h"
#include "tests/catch.h"
#include "tests/support/lattice_boxes.h"
#include "tests/support/random_lattice.h"

using namespace bp;
using namespace bp::test;

namespace {

/// A surface over a square of n x n fields, and its underside.
LatticeMesh rough_plate(int n, std::int64_t height, unsigned seed) {
  LatticeMesh mesh;
  RandomLattice random(seed);
  for (int side = 0; side < 2; ++side) {
    const auto first = std::uint32_t(mesh.vertices.size());
    for (int y = 0; y <= n; ++y)
      for (int x = 0; x <= n; ++x) mesh.vertices.push_back({100 * x, 100 * y, side * 1000 + random.between(0, height)});
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        const auto a = first + std::uint32_t(y * (n + 1) + x), b = a + 1, c = a + std::uint32_t(n) + 1, d = c + 1;
        mesh.triangles.push_back(side == 1 ? Triangle{a, b, d} : Triangle{a, d, b});
        mesh.triangles.push_back(side == 1 ? Triangle{a, d, c} : Triangle{a, c, d});
      }
    }
  }
  return mesh;
}

/// A spiral staircase of two turns: seen from above it lies over itself.
LatticeMesh spiral() {
  LatticeMesh mesh;
  constexpr int kSteps = 48;
  for (int i = 0; i <= kSteps; ++i) {
    const double t = i * 4 * 3.14159265 / kSteps;
    for (const double r : {1000.0, 3000.0})
      mesh.vertices.push_back({std::int64_t(r * std::cos(t)), std::int64_t(r * std::sin(t)), 20 * i});
  }
  for (std::uint32_t i = 0; i < kSteps; ++i) {
    mesh.triangles.push_back({2 * i, 2 * i + 1, 2 * i + 3});
    mesh.triangles.push_back({2 * i, 2 * i + 3, 2 * i + 2});
  }
  return mesh;
}

double area_of(const std::array<std::array<float, 2>, 3>& t) {
  return (double(t[1][0] - t[0][0]) * (t[2][1] - t[0][1]) - double(t[2][0] - t[0][0]) * (t[1][1] - t[0][1])) / 2;
}

/// Returns how many texel centres lie in two faces, by rasterising; those on an edge are in neither.
std::size_t covered_twice(const Atlas& atlas) {
  constexpr int kFine = 4;  // points along a texel
  std::vector<bool> taken(std::size_t(kFine * kFine) * std::size_t(atlas.width) * std::size_t(atlas.height));
  std::size_t twice = 0;
  for (const auto& t : atlas.corners) {
    const auto [left, right] = std::minmax({t[0][0], t[1][0], t[2][0]});
    const auto [top, bottom] = std::minmax({t[0][1], t[1][1], t[2][1]});
    for (int y = int(top) * kFine; y < (int(bottom) + 1) * kFine; ++y) {
      for (int x = int(left) * kFine; x < (int(right) + 1) * kFine; ++x) {
        const double px = (x + 0.5) / kFine, py = (y + 0.5) / kFine, sign = area_of(t) < 0 ? -1 : 1;
        bool inside = true;
        for (std::size_t k = 0; k < 3; ++k) {
          const auto &a = t[k], &b = t[(k + 1) % 3];
          const double side = (double(b[0]) - a[0]) * (py - a[1]) - (double(b[1]) - a[1]) * (px - a[0]);
          inside = inside && sign * side > 1e-3;
        }
        if (!inside) continue;
        const std::size_t at = std::size_t(y) * std::size_t(kFine * atlas.width) + std::size_t(x);
        twice += taken[at];
        taken[at] = true;
      }
    }
  }
  return twice;
}

/// Squares of 4 x 4 texels that faces of two charts touch.
std::size_t shared_squares(const Atlas& atlas) {
  std::map<std::pair<int, int>, std::set<std::uint32_t>> charts;
  for (std::size_t i = 0; i < atlas.corners.size(); ++i) {
    const auto& t = atlas.corners[i];
    const auto [left, right] = std::minmax({t[0][0], t[1][0], t[2][0]});
    const auto [top, bottom] = std::minmax({t[0][1], t[1][1], t[2][1]});
    // The face with half a texel around it, which interpolation between texels reads.
    for (int y = int(std::floor((top - 0.5F) / 4)); y <= int(std::floor((bottom + 0.5F) / 4)); ++y)
      for (int x = int(std::floor((left - 0.5F) / 4)); x <= int(std::floor((right + 0.5F) / 4)); ++x)
        charts[{x, y}].insert(atlas.chart[i]);
  }
  return std::size_t(std::count_if(charts.begin(), charts.end(), [](const auto& c) { return c.second.size() > 1; }));
}

}  // namespace

TEST_CASE("faces in an atlas lie side by side, inside it, with room between charts", "[quick][atlas]") {
  LatticeMesh boxes;
  add_box(boxes, {{0, 0, 0}, {640, 320, 200}});
  add_box(boxes, {{1000, 0, 0}, {1100, 3000, 20}});
  for (const LatticeMesh& mesh : {boxes, rough_plate(12, 30, 1), rough_plate(12, 400, 2), spiral()}) {
    for (const double texel : {10.0, 37.0, 300.0}) {
      const Atlas atlas = unwrap(mesh, {texel, 4096});
      REQUIRE(atlas.corners.size() == mesh.triangles.size());
      CHECK(atlas.texel == texel);
      CHECK(atlas.width % 4 == 0);
      CHECK(atlas.height % 4 == 0);
      for (const auto& t : atlas.corners) {
        for (const auto& p : t) {
          CHECK(p[0] >= 1);
          CHECK(p[1] >= 1);
          CHECK(p[0] <= float(atlas.width) - 1);
          CHECK(p[1] <= float(atlas.height) - 1);
        }
      }
      CHECK(covered_twice(atlas) == 0);
      CHECK(shared_squares(atlas) == 0);
    }
  }
}

TEST_CASE("texels are of one size on the mesh", "[quick][atlas]") {
  LatticeMesh mesh;
  add_box(mesh, {{0, 0, 0}, {640, 320, 200}});
  const Atlas flat = unwrap(mesh, {8, 4096});
  const LatticeMesh rough = rough_plate(12, 60, 3);
  const Atlas atlas = unwrap(rough, {8, 4096});
  const auto share = [](const LatticeMesh& m, const Atlas& a, std::size_t i) {
    const auto edge = [&](std::size_t k) {
      const LatticeCoord d = m.vertices[m.triangles[i][k]] - m.vertices[m.triangles[i][0]];
      return Vec3d{double(d.x), double(d.y), double(d.z)};
    };
    return std::abs(area_of(a.corners[i])) * a.texel * a.texel / (length(cross(edge(1), edge(2))) / 2);
  };
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) CHECK(share(mesh, flat, i) == Approx(1).margin(1e-4));
  for (std::size_t i = 0; i < rough.triangles.size(); ++i) {
    CHECK(share(rough, atlas, i) > 0.25);
    CHECK(share(rough, atlas, i) < 1.0001);
  }
}

TEST_CASE("a vertex has one place in each of its charts", "[quick][atlas]") {
  const LatticeMesh mesh = rough_plate(10, 300, 4);
  const Atlas atlas = unwrap(mesh, {25, 4096});
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::array<float, 2>> places;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [at, is_new] = places.try_emplace({mesh.triangles[i][k], atlas.chart[i]}, atlas.corners[i][k]);
      CHECK(at->second == atlas.corners[i][k]);
    }
  }
}

TEST_CASE("an image that would be too large has larger texels", "[quick][atlas]") {
  const LatticeMesh mesh = rough_plate(12, 400, 2);
  const Atlas atlas = unwrap(mesh, {1, 256});
  CHECK(atlas.width <= 256);
  CHECK(atlas.height <= 256);
  CHECK(atlas.texel > 10);
  CHECK(covered_twice(atlas) == 0);
  REQUIRE_THROWS_AS(unwrap(mesh, {1, 8}), Error);
  REQUIRE_THROWS_AS(unwrap(LatticeMesh{}, {1, 256}), Error);
}

TEST_CASE("faces without area, and meshes that are no surface, are unwrapped", "[quick][atlas]") {
  RandomLattice random(9);
  LatticeMesh mesh;
  for (int i = 0; i < 60; ++i) mesh.vertices.push_back(random.point(-500, 500));
  for (int i = 0; i < 150; ++i) {
    const auto pick = [&] { return std::uint32_t(random.between(0, 59)); };
    mesh.triangles.push_back({pick(), pick(), pick()});
  }
  const Atlas atlas = unwrap(mesh, {20, 4096});
  CHECK(covered_twice(atlas) == 0);
  CHECK(shared_squares(atlas) == 0);
}
