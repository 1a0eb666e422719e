#include <random>

#include "lib/hulls/convex_budget.h"
#include "lib/hulls/detail/convex_shape.h"
#include "lib/hulls/detail/convex_steps.h"
#include "lib/hulls/detail/convex_tighten.h"
#include "lib/mesh/lattice_geometry.h"
#include "tests/catch.h"
#include "tests/support/lattice_boxes.h"
#include "tests/unit/check/meshes.h"

namespace bp::test {

namespace {

double least_angle(const ConvexHull& hull) {
  double least = 180;
  for (const auto& t : hull.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const LatticeCoord a = hull.vertices[t[k]];
      const Vec3d u = to_double(hull.vertices[t[(k + 1) % 3]] - a), v = to_double(hull.vertices[t[(k + 2) % 3]] - a);
      least = std::min(least, std::atan2(length(cross(u, v)), dot(u, v)) * 180 / 3.141592653589793);
    }
  }
  return least;
}

double shortest_edge(const ConvexHull& hull) {
  double least = 1e300;
  for (const auto& t : hull.triangles) {
    for (std::size_t k = 0; k < 3; ++k)
      least = std::min(least, length(to_double(hull.vertices[t[k]] - hull.vertices[t[(k + 1) % 3]])));
  }
  return least;
}

ConvexHull box_hull(const LatticeCoord& size) {
  LatticeMesh box;
  add_box(box, {{0, 0, 0}, size});
  return *hull_of(box.vertices);
}

ConvexHull ball(int levels, double radius) {
  std::vector<LatticeCoord> points;
  for (const Vec3d& p : sphere(levels, radius).vertices) points.push_back(rounded(p));
  return *hull_of(points);
}

/// A box whose corners are cut and jittered by a few units of some thousands: as cells that were cut leave them.
ConvexHull frayed_box(unsigned seed) {
  std::mt19937 random(seed);
  const auto jitter = [&] { return std::int64_t(random() % 5); };
  std::vector<LatticeCoord> points;
  for (const LatticeCoord& corner : box_hull({6000, 4000, 2500}).vertices) {
    for (int i = 0; i < 4; ++i) points.push_back(corner + LatticeCoord{jitter(), jitter(), jitter()});
  }
  return *hull_of(points);
}

}  // namespace

TEST_CASE("slivers are merged away, and the hull stays around what it was", "[quick][meshing][lod]") {
  const auto seed = GENERATE(range(0u, 12u));
  CAPTURE(seed);
  const ConvexHull hull = frayed_box(seed);
  REQUIRE(least_angle(hull) < 0.1);
  REQUIRE(shortest_edge(hull) < 7);
  const ConvexHull clean = without_slivers(hull);
  CHECK(least_angle(clean) > 1);
  CHECK(shortest_edge(clean) > 7);
  CHECK(slivers_of(hull) > 0);
  CHECK(slivers_of(clean) == 0);
  CHECK(clean.vertices.size() <= hull.vertices.size());
  CHECK(holds_all(clean, hull.vertices));
  CHECK(volume6_of(clean) < 1.01 * volume6_of(hull));
}

TEST_CASE("a plate and a needle stay what they are", "[quick][meshing][lod]") {
  const LatticeCoord size =
      GENERATE(LatticeCoord{100000, 80000, 64}, LatticeCoord{100000, 64, 64}, LatticeCoord{1, 1, 1});
  const ConvexHull hull = box_hull(size);
  CHECK(slivers_of(hull) == 0);
  CHECK(volume6_of(without_slivers(hull)) == volume6_of(hull));
}

TEST_CASE("a slanted sheet keeps slivers rather than become its box", "[quick][meshing][lod]") {
  std::mt19937 random(7);
  int with_slivers = 0;
  for (int i = 0; i < 50; ++i) {
    std::vector<LatticeCoord> points;
    for (const Vec3d& p : {Vec3d{0, 0, 0}, {14560, 3640, 1092}, {16380, 10920, 10920}, {1820, 7280, 9828}}) {
      for (const double side : {-2.0, 2.0}) {
        points.push_back(rounded(p + side * Vec3d{0.160, -0.744, 0.649}));
        for (int k = 0; k < 3; ++k) points.back()[k] += std::int64_t(random() % 3) - 1;
      }
    }
    const ConvexHull hull = *hull_of(points);
    with_slivers += slivers_of(hull) > 0;
    const ConvexHull made = without_slivers(hull);
    CHECK(holds_all(made, hull.vertices));
    CHECK(volume6_of(made) < 2 * volume6_of(hull));
  }
  CHECK(with_slivers > 10);
}

TEST_CASE("diagonals of flat facets have the larger angles, and the solid is the same", "[quick][meshing][lod]") {
  std::vector<LatticeCoord> points;
  for (int i = 0; i < 24; ++i) {  // a prism of 24 sides, which a fan of its ends would make slivers of
    const double a = i * 3.141592653589793 / 12;
    for (const std::int64_t z : {0, 5000})
      points.push_back({std::llround(9e5 * std::cos(a)), std::llround(9e5 * std::sin(a)), z * 100});
  }
  ConvexHull hull = *hull_of(points);
  const double volume6 = volume6_of(hull), before = least_angle(hull);
  draw_diagonals(hull);
  CHECK(volume6_of(hull) == volume6);
  CHECK(least_angle(hull) >= before);
  CHECK(least_angle(hull) > 7);
}

TEST_CASE("faces go from where they cost least, in all hulls together", "[quick][meshing][lod]") {
  const std::uint64_t faces = GENERATE(std::uint64_t(8), std::uint64_t(40), std::uint64_t(90), std::uint64_t(200));
  CAPTURE(faces);
  const std::vector<ConvexHull> before{ball(2, 3000), ball(2, 300)};
  std::vector<ConvexHull> hulls = before;
  keep_to_faces(hulls, faces, kFarOut);
  CHECK(face_count(hulls) <= faces);
  CHECK(face_count(hulls) + 6 >= faces);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(holds_all(hulls[i], before[i].vertices));
    CHECK(slivers_of(hulls[i]) == 0);
  }
  if (faces > 8) CHECK(hulls[0].triangles.size() > hulls[1].triangles.size());
  keep_to_faces(hulls, 3, kFarOut);  // no hull has so few
  CHECK(face_count(hulls) == 8);
}

TEST_CASE("a lens with few faces stays near its box, until it has twelve or fewer", "[quick][meshing][lod]") {
  const std::uint64_t faces = GENERATE(std::uint64_t(4), std::uint64_t(12), std::uint64_t(16), std::uint64_t(40));
  CAPTURE(faces);
  std::vector<LatticeCoord> points;  // its rim is sharp: what lies beyond the planes there lies far out
  for (const LatticeCoord& p : ball(3, 3000).vertices)
    points.push_back({p.x + p.z / 2, p.y, (p.z > 0 ? 1 : -1) * p.z * p.z / 30000});
  const ConvexHull lens = *hull_of(points);
  std::vector<ConvexHull> hulls{lens};
  keep_to_faces(hulls, faces, kNearBox);
  CHECK(face_count(hulls) <= std::max<std::uint64_t>(faces, 12));
  CHECK(room_around(lens, kNearBox).holds(box_of(hulls[0].vertices)));
  CHECK(holds_all(hulls[0], lens.vertices));
}

TEST_CASE("corners are drawn to what the hull is around", "[quick][meshing][lod]") {
  const ConvexHull inner = ball(3, 3000);
  std::vector<ConvexHull> outer{inner};
  keep_to_faces(outer, 30, kFarOut);
  const ConvexHull tight = tightened(outer[0], inner.vertices);
  CHECK(holds_all(tight, inner.vertices));
  CHECK(volume6_of(tight) < 0.995 * volume6_of(outer[0]));
  CHECK(tight.vertices.size() <= outer[0].vertices.size());
  const ConvexHull box = box_hull({300, 200, 100});
  CHECK(volume6_of(tightened(box, box.vertices)) == volume6_of(box));
}

}  // namespace bp::test
