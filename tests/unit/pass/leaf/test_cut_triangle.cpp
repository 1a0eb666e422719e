#include <algorithm>
#include <random>
#include <set>

#include "lib/pass/leaf/detail/cut_triangle.h"
#include "tests/catch.h"

using namespace bp;

namespace {

using Points = std::set<std::pair<Vec3d, std::array<double, 2>>>;

/// Corners of a strip of two triangles with a common edge, from 1 to 2.
std::array<CutPoint, 4> random_strip(std::mt19937& rand) {
  std::array<CutPoint, 4> all;
  for (CutPoint& p : all) {
    for (double& x : p.at) x = double(rand()) / double(std::mt19937::max()) * 3 - 1;
    for (double& x : p.uv) x = double(rand()) / double(std::mt19937::max());
  }
  return all;
}

/// Returns the points of a triangle's part in a box that lie in the plane x[axis] = at.
Points in_plane(const std::array<CutPoint, 3>& t, const Bounds3d& box, std::size_t axis, double at) {
  Points points;
  for (const CutPoint& p : cut_triangle(t, box))
    if (p.at[axis] == at) points.insert({p.at, p.uv});
  return points;
}

const Bounds3d kUnevenBox{{0, 0, 0}, {0.7, 0.8, 0.9}};

/// compared(strip, i) for many strips; returns the sum of the numbers of points that it compared.
template <class Compared>
std::size_t for_each_strip(unsigned seed, const Compared& compared) {
  std::mt19937 rand(seed);
  std::size_t points = 0;
  for (int i = 0; i < 3000; ++i) points += compared(random_strip(rand), i);
  return points;
}

/// compared(t, i, axis) for the first triangle of many strips, and each axis.
template <class Compared>
std::size_t for_each_triangle(unsigned seed, const Compared& compared) {
  return for_each_strip(seed, [&](const std::array<CutPoint, 4>& strip, int i) {
    std::size_t points = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      points += compared(std::array<CutPoint, 3>{strip[0], strip[1], strip[2]}, i, axis);
    return points;
  });
}

}  // namespace

TEST_CASE("boxes on both sides of a face cut a triangle at the same points, bit for bit", "[quick][leaf]") {
  const std::size_t points = for_each_triangle(3, [](const std::array<CutPoint, 3>& t, int i, std::size_t axis) {
    Bounds3d beside = kUnevenBox;
    beside.min[axis] = kUnevenBox.max[axis];
    beside.max[axis] = kUnevenBox.max[axis] + (i % 2 == 0 ? 0.3 : 2.0);
    const Points here = in_plane(t, kUnevenBox, axis, kUnevenBox.max[axis]);
    CHECK(here == in_plane({t[2], t[1], t[0]}, beside, axis, kUnevenBox.max[axis]));
    return here.size();
  });
  CHECK(points > 1000);
}

TEST_CASE("a box and its smaller neighbours have the same points where their edges meet", "[quick][leaf]") {
  const std::size_t points = for_each_triangle(5, [](const std::array<CutPoint, 3>& t, int, std::size_t axis) {
    Points small;
    for (int k = 0; k < 4; ++k) {
      Bounds3d beside = kUnevenBox;
      beside.min[axis] = kUnevenBox.max[axis];
      beside.max[axis] = kUnevenBox.max[axis] + 0.4;
      for (std::size_t j = 0; j < 2; ++j) {
        const std::size_t a = (axis + 1 + j) % 3;
        ((k >> j & 1) != 0 ? beside.min[a] : beside.max[a]) = kUnevenBox.max[a] / 2;
      }
      small.merge(in_plane(t, beside, axis, kUnevenBox.max[axis]));
    }
    const Points here = in_plane(t, kUnevenBox, axis, kUnevenBox.max[axis]);
    CHECK(std::includes(small.begin(), small.end(), here.begin(), here.end()));
    return here.size();
  });
  CHECK(points > 1000);
}

TEST_CASE("triangles with a common edge are cut at the same points of it", "[quick][leaf]") {
  const auto cut = [](const std::array<CutPoint, 3>& t) {
    Points all;
    for (const CutPoint& q : cut_triangle(t, kUnevenBox)) all.insert({q.at, q.uv});
    return all;
  };
  const std::size_t common = for_each_strip(4, [&](const std::array<CutPoint, 4>& p, int) {
    const Points left = cut({p[0], p[1], p[2]}), right = cut({p[3], p[2], p[1]}), edge = cut({p[1], p[2], p[2]});
    CHECK(std::includes(left.begin(), left.end(), edge.begin(), edge.end()));
    CHECK(std::includes(right.begin(), right.end(), edge.begin(), edge.end()));
    return edge.size();
  });
  CHECK(common > 1000);
}
