#include <random>

#include "lib/exact/triangle_intersection.h"
#include "tests/catch.h"
#include "tests/reference/triangle_clip.h"

using namespace bp;
using reference::Point;
using reference::Triangle;

namespace {

template <class P>
P convert(const Point& p);
template <>
LatticeCoord convert<LatticeCoord>(const Point& p) {
  return {p[0], p[1], p[2]};
}
template <>
Vec3d convert<Vec3d>(const Point& p) {  // far from the origin, where sums of products round
  return {1e5 + double(p[0]) / 1024, -3e5 + double(p[1]) / 1024, 7e6 + double(p[2]) / 1024};
}

template <class P>
std::array<P, 3> convert(const Triangle& t) {
  return {convert<P>(t[0]), convert<P>(t[1]), convert<P>(t[2])};
}

Triangle random_triangle(std::mt19937_64& random, long size) {
  std::uniform_int_distribution<long> c(0, size);
  Triangle t;
  do {
    for (Point& p : t) p = {c(random), c(random), c(random)};
  } while (reference::zero_area(t));
  return t;
}

}  // namespace

TEMPLATE_TEST_CASE("triangle intersection equals rational clipping where all coincidences occur", "[quick][core]",
                   LatticeCoord, Vec3d) {
  const long size = GENERATE(1L, 2L, 3L, 6L);
  std::mt19937_64 random{std::uint64_t(size)};
  int meeting = 0, touching = 0;
  for (int n = 0; n < 20000; ++n) {
    const Triangle a = random_triangle(random, size), b = random_triangle(random, size);
    const auto figure = reference::intersection(a, b);
    const auto pa = convert<TestType>(a), pb = convert<TestType>(b);
    const bool expected = !figure.empty();
    meeting += expected, touching += figure.size() == 1;
    if (triangles_intersect(pa.data(), pb.data()) != expected ||
        triangles_intersect(pb.data(), pa.data()) != expected) {
      CAPTURE(a, b);
      REQUIRE(triangles_intersect(pa.data(), pb.data()) == expected);
      REQUIRE(triangles_intersect(pb.data(), pa.data()) == expected);
    }
  }
  CHECK(meeting > 1000);
  CHECK(meeting < 19990);
  if (size < 6) CHECK(touching > 20);
}

TEMPLATE_TEST_CASE("triangles that share a vertex or an edge meet beyond it as rational clipping says", "[quick][core]",
                   LatticeCoord, Vec3d) {
  const long size = GENERATE(1L, 2L, 3L, 5L);
  const int shared = GENERATE(1, 2);
  std::mt19937_64 random{std::uint64_t(size)};
  int meeting = 0;
  for (int n = 0; n < 10000; ++n) {
    // Points 0..4; the triangles share corner 0, or the edge 0-1, with every rotation and orientation.
    const Triangle a = random_triangle(random, size);
    Triangle b = random_triangle(random, size);
    for (int i = 0; i < shared; ++i) b[std::size_t(i)] = a[std::size_t(i)];
    if (reference::zero_area(b)) continue;
    const TestType points[5] = {convert<TestType>(a[0]), convert<TestType>(a[1]), convert<TestType>(a[2]),
                                convert<TestType>(shared == 1 ? b[1] : b[2]), convert<TestType>(b[2])};
    std::array<int, 3> ia = {0, 1, 2}, ib = shared == 1 ? std::array{0, 3, 4} : std::array{0, 1, 3};
    for (int i = n % 3; i-- > 0;) std::rotate(ia.begin(), ia.begin() + 1, ia.end());
    for (int i = n / 3 % 3; i-- > 0;) std::rotate(ib.begin(), ib.begin() + 1, ib.end());
    if (n / 9 % 2 != 0) std::swap(ib[0], ib[1]);
    bool expected = false;
    for (const auto& p : reference::intersection(a, b))
      expected |= shared == 1 ? !is_point(p, a[0]) : !on_segment(p, a[0], a[1]);
    meeting += expected;
    CAPTURE(a, b, ia, ib);
    REQUIRE(triangles_meet_beyond_shared(points, ia, ib) == expected);
    REQUIRE(triangles_meet_beyond_shared(points, ib, ia) == expected);
  }
  CHECK(meeting > 100);
  CHECK(meeting < 9900);
}

TEMPLATE_TEST_CASE("a segment or a point given as a triangle of no area meets what clipping says", "[quick][core]",
                   LatticeCoord, Vec3d) {
  std::mt19937_64 random(11);
  std::uniform_int_distribution<long> c(0, 3), t(0, 2);
  int meeting = 0;
  for (int n = 0; n < 20000; ++n) {
    const Point p{c(random), c(random), c(random)}, d{t(random), t(random), t(random)};
    const Triangle a{p, Point{p[0] + d[0], p[1] + d[1], p[2] + d[2]},
                     Point{p[0] + 2 * d[0], p[1] + 2 * d[1], p[2] + 2 * d[2]}};
    const Triangle b = random_triangle(random, 3);
    const bool expected = !reference::intersection(a, b).empty();
    meeting += expected;
    const auto pa = convert<TestType>(a), pb = convert<TestType>(b);
    CAPTURE(a, b);
    REQUIRE(degenerate_triangle_meets(pa.data(), pb.data()) == expected);
  }
  CHECK(meeting > 500);
}

TEST_CASE("a triangle one unit in the last place above another does not touch it", "[quick][core]") {
  const Vec3d a[3] = {{6e6, 6e6, 6e6}, {6e6 + 3, 6e6 + 1, 6e6 + 1}, {6e6 + 1, 6e6 + 3, 6e6 + 2}};
  Vec3d b[3];
  for (int i = 0; i < 3; ++i) b[i] = {a[i][0], a[i][1], std::nextafter(a[i][2], 1e9)};
  CHECK(triangles_intersect(a, a));
  CHECK_FALSE(triangles_intersect(a, b));
  b[1] = a[1];
  CHECK(triangles_intersect(a, b));
}
