#include "lib/atlas/tangents.h"

#include <cmath>

#include "lib/core/vec3.h"

namespace bp {

namespace {

Vec3d direction(LatticeCoord from, LatticeCoord to) {
  const LatticeCoord d = to - from;
  return {double(d.x), double(d.y), double(d.z)};
}

/// Returns the part of v that is orthogonal to the unit vector n, at length 1.
Vec3d in_plane(const Vec3d& v, const Vec3d& n) {
  return unit(v - dot(n, v) * n, {});
}

Vec3d any_in_plane(const Vec3d& n) {
  return in_plane(std::abs(n[0]) < 0.5 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0}, n);
}

}  // namespace

std::vector<std::array<float, 4>> tangents_of(const LatticeMesh& mesh, const ShadedMesh& drawn) {
  std::vector<Vec3d> sums(drawn.vertex.size(), Vec3d{});
  std::vector<double> signs(drawn.vertex.size(), 0);
  const auto normal = [&](std::uint32_t copy) {
    const std::array<float, 3>& n = drawn.normals[copy];
    return Vec3d{n[0], n[1], n[2]};
  };
  for (const auto& t : drawn.triangles) {
    const auto at = [&](std::size_t k) { return mesh.vertices[drawn.vertex[t[k % 3]]]; };
    const auto &a = drawn.uv[t[0]], &b = drawn.uv[t[1]], &c = drawn.uv[t[2]];
    const double u1 = double(b[0]) - a[0], v1 = double(b[1]) - a[1], u2 = double(c[0]) - a[0], v2 = double(c[1]) - a[1];
    const double area = u1 * v2 - u2 * v1;  // v goes down, so it is negative if the image is not mirrored
    if (area == 0) continue;
    const Vec3d e1 = direction(at(0), at(1)), e2 = direction(at(0), at(2));
    const Vec3d along = (area < 0 ? -1.0 : 1.0) * (v2 * e1 - v1 * e2);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d n = normal(t[k]);
      const Vec3d p = in_plane(direction(at(k), at(k + 1)), n), q = in_plane(direction(at(k), at(k + 2)), n);
      const double angle = std::acos(std::min(1.0, std::max(-1.0, dot(p, q))));
      sums[t[k]] = sums[t[k]] + angle * in_plane(along, n);
      signs[t[k]] += area < 0 ? angle : -angle;
    }
  }
  std::vector<std::array<float, 4>> tangents;
  tangents.reserve(sums.size());
  for (std::uint32_t copy = 0; copy < sums.size(); ++copy) {
    const Vec3d n = normal(copy);
    Vec3d t = in_plane(sums[copy], n);
    if (!(dot(t, t) > 0.5)) t = any_in_plane(n);
    tangents.push_back({float(t[0]), float(t[1]), float(t[2]), signs[copy] < 0 ? -1.0F : 1.0F});
  }
  return tangents;
}

}  // namespace bp
