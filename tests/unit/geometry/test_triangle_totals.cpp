#include <algorithm>
#include <limits>

#include "lib/geometry/triangle_totals.h"
#include "tests/catch.h"

using namespace bp;

namespace {

std::vector<TriangleD> tetrahedron(double at) {
  const Vec3d o{at, at, at}, x{at + 1, at, at}, y{at, at + 1, at}, z{at, at, at + 1};
  return {{o, y, x}, {o, x, z}, {o, z, y}, {x, y, z}};
}

TriangleTotals totals_of(const std::vector<TriangleD>& triangles) {
  TriangleTotals t;
  t.add(triangles);
  return t;
}

}  // namespace

TEST_CASE("volume and area of a solid, near and far", "[quick][core]") {
  const double at = GENERATE(0.0, 1048576.0 * 16);
  const TriangleTotals t = totals_of(tetrahedron(at));
  CHECK(t.triangles == 4);
  CHECK(std::abs(*t.volume - 1.0 / 6) < 1e-12);
  CHECK(std::abs(t.area - (1.5 + std::sqrt(3) / 2)) < 1e-12);
  CHECK(t.bounds.min == Vec3d{at, at, at});
  CHECK(t.bounds.max == Vec3d{at + 1, at + 1, at + 1});
}

TEST_CASE("a closed surface has a volume however thin it is; an open one has none", "[quick][core]") {
  const double thin = GENERATE(1.0, 1e-4, 1e-7, 1e-9, 1e-11);
  const double turn = GENERATE(0.0, 0.3, 1.1);
  CAPTURE(thin, turn);
  // A prism over a long triangle, turned so that its coordinates are rounded.
  const auto at = [&](double x, double y, double z) {
    const double c = std::cos(turn), s = std::sin(turn);
    return Vec3d{c * x - s * y, s * c * x + c * c * y - s * z, s * s * x + s * c * y + c * z};
  };
  const Vec3d a = at(0, 0, 0), b = at(1, 0, 0), c = at(0.5, thin, 0), d = at(0, 0, thin), e = at(1, 0, thin),
              f = at(0.5, thin, thin);
  std::vector<TriangleD> prism{{a, c, b}, {d, e, f}, {a, b, e}, {a, e, d}, {b, c, f}, {b, f, e}, {c, a, d}, {c, d, f}};
  CHECK(totals_of(prism).volume);
  std::swap(prism[0][1], prism[0][2]);
  CHECK_FALSE(totals_of(prism).volume);
}

TEST_CASE("a surface that is open or faces both ways has no volume, whatever its place", "[quick][core]") {
  const double at = GENERATE(0.0, 6e6 + 1.0 / 3);
  std::vector<TriangleD> t = tetrahedron(at);
  CHECK(totals_of(t).volume);
  std::swap(t[1][0], t[1][1]);
  CHECK_FALSE(totals_of(t).volume);
  t.erase(t.begin() + 1);
  CHECK_FALSE(totals_of(t).volume);
  CHECK(volume_text({}).find("none") == 0);
  CHECK(volume_text(27) == "27");
  CHECK(volume_text(-27) == "-27: the faces point inwards");
}

TEST_CASE("the checksum of a mesh is that of its triangles as a set", "[quick][core]") {
  std::vector<TriangleD> t = tetrahedron(2);
  const std::string sum = totals_of(t).checksum();
  CHECK(sum.size() == 32);
  std::reverse(t.begin(), t.end());
  std::rotate(t[1].begin(), t[1].begin() + 1, t[1].end());
  CHECK(totals_of(t).checksum() == sum);
  TriangleTotals parts;
  parts.add({t.data(), 1});
  parts.add({t.data() + 1, 3});
  CHECK(parts.checksum() == sum);
  std::swap(t[0][0], t[0][1]);  // inside out
  CHECK(totals_of(t).checksum() != sum);
  std::swap(t[0][0], t[0][1]);
  t.push_back(t[0]);  // twice
  CHECK(totals_of(t).checksum() != sum);
  t.pop_back();
  t[0][0][0] += 1e-12;
  CHECK(totals_of(t).checksum() != sum);
  CHECK(totals_of({}).checksum() == std::string(32, '0'));
}

TEST_CASE("what is not finite counts, but measures nothing", "[quick][core]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<TriangleD> t = tetrahedron(0);
  const TriangleTotals before = totals_of(t);
  t.push_back({Vec3d{nan, 0, 0}, Vec3d{1, 0, 0}, Vec3d{0, 1, 0}});
  t.push_back({Vec3d{1e300, 0, 0}, Vec3d{1, 0, 0}, Vec3d{0, 1e300, 0}});
  const TriangleTotals after = totals_of(t);
  CHECK(after.triangles == 6);
  CHECK(after.volume == before.volume);
  CHECK(after.bounds == before.bounds);
}
