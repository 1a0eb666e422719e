#include <cmath>
#include <random>

#include "lib/hulls/convex_parts.h"
#include "lib/hulls/convex_scene.h"
#include "lib/hulls/detail/convex_tighten.h"
#include "lib/hulls/outward_hull.h"
#include "lib/mesh/lattice_geometry.h"
#include "tests/catch.h"
#include "tests/unit/check/meshes.h"

namespace bp::test {

namespace {

using Scene = std::vector<TriangleD>;

/// A box whose corners are turned around z.
void add_turned_box(Scene& out, const Vec3d& lo, const Vec3d& hi, double turn) {
  std::array<Vec3d, 8> p;
  for (std::size_t i = 0; i < 8; ++i) {
    const double x = (i & 1 ? hi : lo)[0], y = (i & 2 ? hi : lo)[1], c = std::cos(turn), s = std::sin(turn);
    p[i] = {x * c - y * s, x * s + y * c, (i & 4 ? hi : lo)[2]};
  }
  const std::size_t quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& q : quads) {
    out.push_back({p[q[0]], p[q[1]], p[q[2]]});
    out.push_back({p[q[0]], p[q[2]], p[q[3]]});
  }
}

/// Four walls and a roof; they touch.
Scene house_of_five(double turn) {
  Scene house;
  add_turned_box(house, {0, 0, 0}, {8, 0.3, 3}, turn);
  add_turned_box(house, {0, 5.7, 0}, {8, 6, 3}, turn);
  add_turned_box(house, {0, 0.3, 0}, {0.3, 5.7, 3}, turn);
  add_turned_box(house, {7.7, 0.3, 0}, {8, 5.7, 3}, turn);
  add_turned_box(house, {-0.5, -0.5, 3}, {8.5, 6.5, 3.4}, turn);
  return house;
}
constexpr double kVolumeOfHouse = 2 * 8 * 0.3 * 3 + 2 * 0.3 * 5.4 * 3 + 9 * 7 * 0.4;

GridFrame frame_of(const Scene& scene, double voxel) {
  Bounds3d bounds;
  for (const TriangleD& t : scene) {
    for (const Vec3d& p : t) bounds.add(p);
  }
  return make_frame(bounds, voxel);
}

/// How far the point lies within the hull, at least; lattice units.
double depth_in(const ConvexHull& hull, const Vec3d& p) {
  double least = HUGE_VAL;
  for (const auto& [a, b, c] : hull.triangles) {
    const Vec3d n = to_double(normal_of(hull.vertices[a], hull.vertices[b], hull.vertices[c]));
    least = std::min(least, dot(to_double(hull.vertices[a]) - p, n) / length(n));
  }
  return least;
}

std::vector<Vec3d> points_in_box(unsigned seed, int n, const Vec3d& size) {
  std::mt19937 random(seed);
  const auto share = [&] { return double(random() % 100000) / 100000; };
  std::vector<Vec3d> points;
  for (int i = 0; i < n; ++i) points.push_back({size[0] * share(), size[1] * share(), size[2] * share()});
  return points;
}

}  // namespace

TEST_CASE("a hull of lattice points lies strictly around points that are not, also of plates and needles",
          "[quick][meshing][lod]") {
  const unsigned seed = GENERATE(range(0u, 8u));
  const Vec3d size = GENERATE(Vec3d{1000, 1000, 1000}, Vec3d{20, 30, 40}, Vec3d{1000, 1000, 0}, Vec3d{1000, 0.3, 0.2},
                              Vec3d{0, 0, 0}, Vec3d{2000, 1500, 6});
  const std::vector<Vec3d> points = points_in_box(seed, 40, size);
  CAPTURE(seed, size[0], size[1], size[2]);
  const ConvexHull hull = outward_hull(points);
  for (const Vec3d& p : points) CHECK(depth_in(hull, p) > 0.05);
}

TEST_CASE("a house of five convex parts becomes five hulls of its volume", "[quick][meshing][lod]") {
  const double turn = GENERATE(0.0, 0.4);
  const Scene house = house_of_five(turn);
  const ConvexScene scene = convex_scene(house);
  CHECK(scene.parts.size() == 5);
  CHECK(scene.rest.empty());
  CHECK(std::abs(scene.volume - kVolumeOfHouse) < 1e-3);
  LatticeMesh none;
  none.frame = frame_of(house, 9.0 / 256);
  const std::vector<ConvexHull> hulls = hulls_around(scene, none.frame, kMostCorners);
  REQUIRE(hulls.size() == 5);
  for (const ConvexHull& hull : hulls) CHECK(hull.vertices.size() == 8);
  const ConvexParts parts = convex_parts(none, {}, hulls);
  REQUIRE(parts.hulls.size() == 5);
  CHECK(volume_of(parts) > kVolumeOfHouse);
  CHECK(volume_of(parts) < 1.03 * kVolumeOfHouse);
  for (const TriangleD& t : house) {
    for (const Vec3d& p : t) {
      const Vec3d q = none.frame.to_lattice(p);
      CHECK(std::any_of(parts.hulls.begin(), parts.hulls.end(), [&](const LatticeMesh& m) {
        return depth_in({m.vertices, m.triangles}, q) > 0;
      }));
    }
  }
}

TEST_CASE("parts that are open, not convex or there twice are left to the rest", "[quick][meshing][lod]") {
  Scene scene;
  add_turned_box(scene, {0, 0, 0}, {1, 1, 1}, 0);  // convex
  add_turned_box(scene, {5, 0, 0}, {6, 1, 1}, 0);
  scene.pop_back();                                  // open
  add_turned_box(scene, {10, 0, 0}, {11, 1, 1}, 0);  // there twice
  add_turned_box(scene, {10, 0, 0}, {11, 1, 1}, 0);
  const IndexedMesh ball = sphere(1, 1);
  for (const auto& t : ball.triangles) {  // dented
    TriangleD triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      triangle[k] = ball.vertices[t[k]];
      if (t[k] == 0) triangle[k] = -0.5 * triangle[k];
      triangle[k][0] += 20;
    }
    scene.push_back(triangle);
  }
  const ConvexScene found = convex_scene(scene);
  CHECK(found.parts.size() == 1);
  CHECK(found.rest.size() == scene.size() - 12);
}

TEST_CASE("a convex part within another one has no hull", "[quick][meshing][lod]") {
  Scene scene;
  add_turned_box(scene, {0.2, 0.2, 0.2}, {0.8, 0.8, 0.8}, 0);
  add_turned_box(scene, {0, 0, 0}, {1, 1, 1}, 0);
  const ConvexScene found = convex_scene(scene);
  CHECK(found.parts.size() == 2);
  CHECK(hulls_around(found, frame_of(scene, 0.01), kMostCorners).size() == 1);
}

TEST_CASE("a convex part keeps to the corners asked for, and its hull loses no point", "[quick][meshing][lod]") {
  const std::size_t most = GENERATE(std::size_t(8), std::size_t(32), std::size_t(64));
  Scene scene;
  const IndexedMesh ball = sphere(3, 1);
  for (const auto& t : ball.triangles) scene.push_back({ball.vertices[t[0]], ball.vertices[t[1]], ball.vertices[t[2]]});
  const ConvexScene found = convex_scene(scene);
  REQUIRE(found.parts.size() == 1);
  const GridFrame frame = frame_of(scene, 0.01);
  const std::vector<ConvexHull> hulls = hulls_around(found, frame, most);
  REQUIRE(hulls.size() == 1);
  CHECK(hulls[0].vertices.size() <= most);
  for (const Vec3d& p : ball.vertices) CHECK(depth_in(hulls[0], frame.to_lattice(p)) > 0);
}

TEST_CASE("more convex parts than hulls are joined", "[quick][meshing][lod]") {
  const Scene house = house_of_five(0);
  LatticeMesh none;
  none.frame = frame_of(house, 9.0 / 256);
  const std::vector<ConvexHull> given = hulls_around(convex_scene(house), none.frame, kMostCorners);
  const ConvexParts parts = convex_parts(none, {2}, given);
  CHECK(parts.hulls.size() <= 2);
  for (const ConvexHull& hull : given) {
    CHECK(std::any_of(parts.hulls.begin(), parts.hulls.end(), [&](const LatticeMesh& m) {
      return holds_all({m.vertices, m.triangles}, hull.vertices);
    }));
  }
}

TEST_CASE("a thin ring is cut across, not into rings", "[quick][meshing][lod]") {
  constexpr std::uint32_t kAround = 48, kRows = 5;
  LatticeMesh ring;  // bulging: slices of it hold a little less than it
  for (std::uint32_t side = 0; side < 2; ++side) {
    for (std::uint32_t row = 0; row < kRows; ++row) {
      for (std::uint32_t i = 0; i < kAround; ++i) {
        const double turn = 2 * 3.14159265358979 * i / kAround, bulge = row * (kRows - 1 - row) * 200.0,
                     radius = (side == 0 ? 10000 : 9700) + bulge;
        ring.vertices.push_back(
            {std::llround(radius * std::cos(turn)), std::llround(radius * std::sin(turn)), 2000 * row});
      }
    }
  }
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    ring.triangles.insert(ring.triangles.end(), {{a, b, c}, {a, c, d}});
  };
  const std::uint32_t inner = kRows * kAround, top = (kRows - 1) * kAround;
  for (std::uint32_t i = 0; i < kAround; ++i) {
    const std::uint32_t j = (i + 1) % kAround;
    for (std::uint32_t r = 0; r < top; r += kAround) {
      quad(r + i, r + j, r + j + kAround, r + i + kAround);
      quad(inner + r + j, inner + r + i, inner + r + i + kAround, inner + r + j + kAround);
    }
    quad(top + i, top + j, inner + top + j, inner + top + i);
    quad(j, i, inner + i, inner + j);
  }
  const double solid = double(volume6_of(ring)) / 6 * std::pow(ring.frame.voxel / kLatticePerVoxel, 3);
  CHECK(volume_of(convex_parts(ring, {32})) < 2.5 * solid);
  const ConvexParts by_default = convex_parts(ring);
  CHECK(by_default.hulls.size() <= kMostLooseHulls);
  CHECK(volume_of(by_default) < 2 * solid);
}

}  // namespace bp::test
