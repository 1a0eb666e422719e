#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>

#include "lib/core/vec3.h"
#include "lib/exact/polygon_cut.h"
#include "lib/exact/predicates.h"
#include "tests/catch.h"

using namespace bp;

namespace {

using Outline = std::vector<Vec3d>;
using Cut = std::vector<CutTriangle>;

Cut fan_of(std::size_t n) {
  Cut fan;
  for (std::size_t i = 0; i + 2 < n; ++i) fan.push_back(fan_triangle(i));
  return fan;
}

/// As readers see it.
Cut cut(const Outline& corners) {
  PolygonCutter cutter;
  const std::span<const CutTriangle> found = cutter.cut(corners);
  return found.empty() ? fan_of(corners.size()) : Cut(found.begin(), found.end());
}

Outline outline(std::initializer_list<std::pair<double, double>> corners) {
  Outline all;
  for (const auto& [x, y] : corners) all.push_back({x, y, 0});
  return all;
}

const Outline kL = outline({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}});
const Outline kU = outline({{0, 0}, {4, 0}, {4, 4}, {3, 4}, {3, 1}, {1, 1}, {1, 4}, {0, 4}});
/// A square with a square hole; a double edge leads to the hole.
const Outline kHole = outline({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}});

Outline star(std::size_t points, double inner) {
  Outline all;
  for (std::size_t i = 0; i < 2 * points; ++i) {
    const double angle = 3.14159265358979 * double(i) / double(points), r = i % 2 == 0 ? 1 : inner;
    all.push_back({r * std::cos(angle), r * std::sin(angle), 0});
  }
  return all;
}

Outline comb(std::size_t teeth) {
  Outline all{{0, 0, 0}, {double(2 * teeth), 0, 0}};
  for (std::size_t i = teeth; i-- > 0;) {
    const auto x = double(2 * i);
    all.insert(all.end(), {{x + 2, 1, 0}, {x + 1.5, 9, 0}, {x + 0.5, 9, 0}, {x + 0.25, 1, 0}});
  }
  return all;
}

/// Each edge with a corner amid it, and each corner twice.
Outline with_more(const Outline& corners) {
  Outline all;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    all.insert(all.end(), {corners[i], corners[i]});
    all.push_back(0.5 * (corners[i] + corners[(i + 1) % corners.size()]));
  }
  return all;
}

Outline turned_back(Outline corners) {
  std::reverse(corners.begin(), corners.end());
  return corners;
}

Outline from_corner(Outline corners, std::size_t k) {
  std::rotate(corners.begin(), corners.begin() + std::ptrdiff_t(k), corners.end());
  return corners;
}

/// Twice the signed area that triangles have, seen along an axis; whole numbers below 2^53 give no rounding.
double area2(const Outline& p, const CutTriangle& t, std::size_t axis) {
  const std::size_t i = (axis + 1) % 3, j = (axis + 2) % 3;
  const Vec3d u = p[t[1]] - p[t[0]], v = p[t[2]] - p[t[0]];
  return u[i] * v[j] - u[j] * v[i];
}

double area2(const Outline& p, const Cut& triangles, std::size_t axis) {
  double sum = 0;
  for (const CutTriangle& t : triangles) sum += area2(p, t, axis);
  return sum;
}

/// Edges of the triangles that do not cancel are those of the polygon.
void check_edges(std::size_t n, const Cut& triangles) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const CutTriangle& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      REQUIRE((a < n && b < n && a != b));
      if (a < b) ++edges[{a, b}];
      if (b < a) --edges[{b, a}];
    }
  }
  std::size_t left = 0;
  for (const auto& [edge, sum] : edges) {
    const bool closing = edge.first == 0 && edge.second + 1 == n;
    if (sum != 0) ++left;
    CHECK(sum == (closing ? -1 : edge.second == edge.first + 1 ? 1 : 0));
  }
  CHECK(left == n);
}

/// Checks the promises of PolygonCutter for an outline that does not cross itself, seen along the axis.
void check_cut(const Outline& p, std::size_t axis = 2) {
  const Cut triangles = cut(p);
  REQUIRE(triangles.size() == p.size() - 2);
  check_edges(p.size(), triangles);
  const double all = area2(p, fan_of(p.size()), axis);
  std::size_t folded = 0;
  double sum = 0;
  for (const CutTriangle& t : triangles) {
    folded += orient2d(p[t[0]], p[t[1]], p[t[2]], int(axis)) * all < 0 ? 1 : 0;
    sum += std::abs(area2(p, t, axis));
  }
  CHECK(folded == 0);
  CHECK(sum == Approx(std::abs(all)).epsilon(1e-9));
}

/// Its corners turned and moved: then they are not in one plane any more, to the last digits.
Outline placed(const Outline& corners, double angle, const Vec3d& at) {
  Outline all;
  for (const Vec3d& p : corners) {
    const double x = p[0] * std::cos(angle) - p[1] * std::sin(angle),
                 y = p[0] * std::sin(angle) + p[1] * std::cos(angle);
    all.push_back(at + Vec3d{x, 0.6 * y, 0.8 * y});
  }
  return all;
}

}  // namespace

TEST_CASE("a polygon whose fan does not fold is its fan", "[quick][exact]") {
  for (const std::size_t n : {3, 4, 5, 17}) {
    Outline ring;
    for (std::size_t i = 0; i < n; ++i)
      ring.push_back({std::cos(6.28 * double(i) / double(n)), 5, std::sin(6.28 * double(i) / double(n))});
    CHECK(cut(ring) == fan_of(n));
    CHECK(cut(turned_back(ring)) == fan_of(n));
  }
  CHECK(cut(kL) == fan_of(6));  // its first corner sees all others
  CHECK(cut(with_more(outline({{0, 0}, {1, 0}, {1, 1}, {0, 1}}))) == fan_of(12));
  CHECK(cut({{0, 0, 0}, {1, 0, 0.3}, {1, 1, 0}, {0, 1, 0.3}}) == fan_of(4));  // not flat
}

TEST_CASE("a quad that is not convex is the fan from its second corner", "[quick][exact]") {
  const Outline dart = outline({{0, 0}, {4, 1}, {0, 4}, {1, 1}});
  CHECK(cut(dart) == Cut{{1, 2, 3}, {1, 3, 0}});
  CHECK(cut(from_corner(dart, 1)) == fan_of(4));
  CHECK(cut(from_corner(dart, 2)) == Cut{{1, 2, 3}, {1, 3, 0}});
  CHECK(cut(from_corner(dart, 3)) == fan_of(4));
  CHECK(cut({{0, 0, 1}, {4, 1, 0}, {0, 4, 1}, {1, 1, 0}}) == Cut{{1, 2, 3}, {1, 3, 0}});  // not flat
}

TEST_CASE("simple polygons are cut without folds, from every corner, either way round, wherever they stand",
          "[quick][exact]") {
  std::vector<Outline> shapes{kL, kU, kHole, star(5, 0.3), star(40, 0.9), comb(6), comb(50)};
  for (std::size_t i = 0, n = shapes.size(); i < n; ++i) shapes.push_back(with_more(shapes[i]));
  for (const Outline& shape : shapes) {
    for (std::size_t k = 0; k < shape.size(); k += 1 + shape.size() / 12) {
      const Outline p = from_corner(shape, k);
      CAPTURE(shape.size(), k);
      check_cut(p);
      check_cut(turned_back(p));
      Outline upright, aside;
      for (const Vec3d& c : p) {
        upright.push_back({c[1], 7, c[0]});
        aside.push_back({-3, c[0], c[1]});
      }
      check_cut(upright, 1);
      check_cut(aside, 0);
    }
  }
}

TEST_CASE("slanted polygons far from the origin are cut without folds", "[quick][exact]") {
  for (const Outline& shape : {kL, kU, star(7, 0.4), comb(9)}) {
    for (std::size_t k = 0; k < shape.size(); ++k) {
      for (const double angle : {0.1, 0.7, 2.0, 4.4})
        check_cut(placed(from_corner(shape, k), angle, {6e6, -6e6, 3e5}), 1);
    }
  }
}

TEST_CASE("random polygons are cut without folds", "[quick][exact]") {
  std::mt19937 random(5);
  for (int round = 0; round < 200; ++round) {
    const std::size_t n = 4 + random() % 40;
    std::vector<double> angles;
    for (std::size_t i = 0; i < n; ++i)
      angles.push_back(6.283 * (double(i) + double(random() % 900) / 1000) / double(n));
    Outline p;
    for (const double a : angles) {
      const double r = 1 + double(random() % 1000);
      p.push_back({std::round(1000 * r * std::cos(a)), std::round(1000 * r * std::sin(a)), double(random() % 1000)});
    }
    CAPTURE(round, n);
    check_cut(from_corner(p, random() % n));  // not flat, and seen from above
  }
}

TEST_CASE("outlines that cross themselves and numbers beyond the domain give the fan", "[quick][exact]") {
  const double huge = 1e200, inf = std::numeric_limits<double>::infinity(), nan = std::nan("");
  CHECK(cut(outline({{0, 0}, {2, 2}, {2, 0}, {0, 1}})) == fan_of(4));
  CHECK(cut(Outline(9, Vec3d{1, 2, 3})) == fan_of(9));
  CHECK(cut(outline({{0, 0}, {3, 0}, {1, 0}, {2, 0}})) == fan_of(4));
  for (const double bad : {huge, 1e-200, inf, -inf, nan}) {
    for (std::size_t k = 0; k < kU.size(); ++k) {
      Outline p = from_corner(kU, 2);
      p[k][k % 3] = bad;
      CHECK(cut(p) == fan_of(8));
    }
  }
}

TEST_CASE("a polygon of more corners than are looked at is its fan", "[quick][exact]") {
  const std::size_t most = PolygonCutter::kMostCorners;
  Outline p = from_corner(comb(most / 4 - 1), 3);
  while (p.size() < most) p.push_back(0.5 * (p.back() + p.front()));
  CHECK_FALSE(cut(p) == fan_of(most));
  check_cut(p);
  p.push_back(0.5 * (p.back() + p.front()));
  CHECK((cut(p) == fan_of(most + 1)));
}

TEST_CASE("random corners give as many triangles with the polygon's edges", "[quick][exact]") {
  std::mt19937 random(9);
  PolygonCutter cutter;
  for (int round = 0; round < 3000; ++round) {
    Outline p(4 + random() % 9);
    for (Vec3d& c : p) c = {double(random() % 4), double(random() % 4), double(random() % 2)};
    CAPTURE(round);
    check_edges(p.size(), cut(p));
    REQUIRE(area2(p, cut(p), 2) == area2(p, fan_of(p.size()), 2));
  }
}
