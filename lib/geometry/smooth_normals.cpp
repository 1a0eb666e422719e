#include "lib/geometry/smooth_normals.h"

#include <algorithm>

#include "lib/core/parallel.h"
#include "lib/core/vec3.h"
#include "lib/geometry/vertex_fans.h"
#include "lib/geometry/welded_triangles.h"

namespace bp {

namespace {

constexpr double kSmoothCosine = 0.766;  // cosine of 40 degrees
constexpr std::size_t kMostInFan = 64;   // triangles: a fan of more is flat enough

Vec3d cross_of(const TriangleD& t) {
  return cross(t[1] - t[0], t[2] - t[0]);
}

}  // namespace

std::vector<std::array<PackedNormal, 3>> smooth_normals(std::span<const TriangleD> triangles) {
  const WeldedTriangles mesh = welded(triangles);
  const VertexFans fans(mesh.triangles, mesh.places.size());
  std::vector<std::array<PackedNormal, 3>> normals(triangles.size());
  parallel_ranges(std::int64_t(triangles.size()), 4096, [&](std::int64_t begin, std::int64_t end) {
    for (auto c = std::size_t(begin) * 3; c < std::size_t(end) * 3; ++c) {
      const Vec3d own = cross_of(triangles[c / 3]);
      const std::span<const std::uint32_t> fan = fans.of(mesh.triangles[c / 3][c % 3]);
      Vec3d sum = own;
      for (const std::uint32_t t : fan.first(std::min(fan.size(), kMostInFan))) {
        if (t == c / 3) continue;
        const Vec3d other = cross_of(triangles[t]);
        if (dot(own, other) > kSmoothCosine * length(own) * length(other)) sum = sum + other;
      }
      normals[c / 3][c % 3] = pack_normal(sum);
    }
  });
  return normals;
}

}  // namespace bp
