#include "tests/reference/voxelize.h"

#include <algorithm>
#include <array>

namespace bp::reference {

namespace {

__extension__ typedef __int128 Wide;
using Vec = std::array<Wide, 3>;

Vec minus(const Vec& a, const Vec& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Wide dot(const Vec& a, const Vec& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

bool separates(const Vec& axis, const std::array<Vec, 3>& t, const Vec& low, const Vec& high) {
  const Wide a = dot(axis, t[0]), b = dot(axis, t[1]), c = dot(axis, t[2]);
  Wide cube_min = 0, cube_max = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    cube_min += std::min(axis[i] * low[i], axis[i] * high[i]);
    cube_max += std::max(axis[i] * low[i], axis[i] * high[i]);
  }
  return std::max({a, b, c}) < cube_min || std::min({a, b, c}) > cube_max;
}

}  // namespace

bool meets(const FixedTriangle& f, const FixedPoint& corner, std::int64_t edge, std::int64_t slack) {
  const Vec first{f.a.x, f.a.y, f.a.z};  // positions relative to a corner of the triangle stay small
  const std::array<Vec, 3> t{Vec{0, 0, 0}, minus({f.b.x, f.b.y, f.b.z}, first), minus({f.c.x, f.c.y, f.c.z}, first)};
  const Vec low = minus({corner.x - slack, corner.y - slack, corner.z - slack}, first);
  const Wide side = edge + 2 * slack;
  const Vec high{low[0] + side, low[1] + side, low[2] + side};
  const std::array<Vec, 3> unit{Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}};
  const std::array<Vec, 3> edges{minus(t[1], t[0]), minus(t[2], t[1]), minus(t[0], t[2])};
  for (const Vec& axis : unit)
    if (separates(axis, t, low, high)) return false;
  for (const Vec& e : edges)
    for (const Vec& axis : unit)
      if (separates(cross(e, axis), t, low, high)) return false;
  return !separates(cross(edges[0], edges[1]), t, low, high);
}

BitBox voxelize(std::span<const FixedTriangle> triangles, BitBox out, std::int64_t slack) {
  const VoxelBox box = out.box();
  for (const FixedTriangle& t : triangles)
    for (std::int32_t z = box.min.z; z < box.max.z; ++z)
      for (std::int32_t y = box.min.y; y < box.max.y; ++y)
        for (std::int32_t x = box.min.x; x < box.max.x; ++x)
          if (meets(t, {x * kFixedOne, y * kFixedOne, z * kFixedOne}, kFixedOne, slack)) out.set({x, y, z});
  return out;
}

}  // namespace bp::reference
