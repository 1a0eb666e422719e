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

/// Of a triangle's part in a box: the points in the plane x[axis] = at.
Points in_plane(const std::array<CutPoint, 3>& t, const Bounds3d& box, std::size_t axis, double at) {
  Points points;
  for (const CutPoint& p : cut_triangle(t, box))
    if (p.at[axis] == at) points.insert({p.at, p.uv});
  return points;
}

}  // namespace

TEST_CASE("boxes on both sides of a face cut a triangle at the same points, bit for bit", "[quick][leaf]") {
  std::mt19937 rand(3);
  const Bounds3d box{{0, 0, 0}, {0.7, 0.8, 0.9}};
  std::size_t points = 0;
  for (int i = 0; i < 3000; ++i) {
    const std::array<CutPoint, 4> strip = random_strip(rand);
    const std::array<CutPoint, 3> t{strip[0], strip[1], strip[2]};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Bounds3d beside = box;
      beside.min[axis] = box.max[axis];
      beside.max[axis] = box.max[axis] + (i % 2 == 0 ? 0.3 : 2.0);
      const Points here = in_plane(t, box, axis, box.max[axis]);
      CHECK(here == in_plane({t[2], t[1], t[0]}, beside, axis, box.max[axis]));
      points += here.size();
    }
  }
  CHECK(points > 1000);
}

TEST_CASE("a box and its smaller neighbours have the same points where their edges meet", "[quick][leaf]") {
  std::mt19937 rand(5);
  const Bounds3d box{{0, 0, 0}, {0.7, 0.8, 0.9}};
  std::size_t points = 0;
  for (int i = 0; i < 3000; ++i) {
    const std::array<CutPoint, 4> strip = random_strip(rand);
    const std::array<CutPoint, 3> t{strip[0], strip[1], strip[2]};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Points small;
      for (int k = 0; k < 4; ++k) {
        Bounds3d beside = box;
        beside.min[axis] = box.max[axis];
        beside.max[axis] = box.max[axis] + 0.4;
        for (std::size_t j = 0; j < 2; ++j) {
          const std::size_t a = (axis + 1 + j) % 3;
          ((k >> j & 1) != 0 ? beside.min[a] : beside.max[a]) = box.max[a] / 2;
        }
        small.merge(in_plane(t, beside, axis, box.max[axis]));
      }
      const Points here = in_plane(t, box, axis, box.max[axis]);
      CHECK(std::includes(small.begin(), small.end(), here.begin(), here.end()));
      points += here.size();
    }
  }
  CHECK(points > 1000);
}

TEST_CASE("triangles with a common edge are cut at the same points of it", "[quick][leaf]") {
  std::mt19937 rand(4);
  const Bounds3d box{{0, 0, 0}, {0.7, 0.8, 0.9}};
  std::size_t common = 0;
  for (int i = 0; i < 3000; ++i) {
    const std::array<CutPoint, 4> p = random_strip(rand);
    const auto cut = [&](const std::array<CutPoint, 3>& t) {
      Points all;
      for (const CutPoint& q : cut_triangle(t, box)) all.insert({q.at, q.uv});
      return all;
    };
    const Points left = cut({p[0], p[1], p[2]}), right = cut({p[3], p[2], p[1]}), edge = cut({p[1], p[2], p[2]});
    CHECK(std::includes(left.begin(), left.end(), edge.begin(), edge.end()));
    CHECK(std::includes(right.begin(), right.end(), edge.begin(), edge.end()));
    common += edge.size();
  }
  CHECK(common > 1000);
}
