#include "lib/fit/detail/face_points.h"

#include <numeric>

#include "lib/core/parallel.h"
#include "lib/core/vec3.h"
#include "lib/geometry/triangle_bvh.h"

namespace bp {

void FacePoints::assign(const HalfEdgeMesh& mesh) {
  std::vector<TriangleD> triangles;
  std::vector<FaceId> faces;
  for (FaceId f = 0; f < mesh.face_capacity(); ++f) {
    if (!mesh.alive(f)) continue;
    triangles.push_back(corners_of(mesh, f));
    faces.push_back(f);
  }
  const TriangleBvh tree(triangles);
  pulls_.resize(points_.size());
  parallel_ranges(std::int64_t(points_.size()), kItemsAtOnce, [&](std::int64_t begin, std::int64_t end) {
    std::uint32_t guess = 0;
    for (auto i = std::size_t(begin); i < std::size_t(end); ++i) {
      const Vec3d& p = points_[i].at;
      guess = tree.nearest(p, guess).item;
      const TriangleBvh::Item& item = tree.item(guess);
      pulls_[i] = {faces[item.id], barycentric(item.corners, nearest_point(p, item.corners))};
    }
  });
  begin_.assign(mesh.face_capacity() + 1, 0);
  for (const Pull& pull : pulls_) ++begin_[pull.face + 1];
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  order_.resize(points_.size());
  std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
  for (std::uint32_t i = 0; i < pulls_.size(); ++i) order_[next[pulls_[i].face]++] = i;
}

std::vector<Quadric> quadrics_of_points(const HalfEdgeMesh& mesh, std::span<const FitPlace> points, double point_area) {
  FacePoints of_faces(points);
  of_faces.assign(mesh);
  std::vector<Quadric> quadrics(mesh.vertex_capacity());
  for (FaceId f = 0; f < mesh.face_capacity(); ++f) {
    if (!mesh.alive(f)) continue;
    const std::array<Vec3d, 3> t = corners_of(mesh, f);
    const Vec3d n = cross(t[1] - t[0], t[2] - t[0]);
    const double size = length(n);
    std::vector<FitPlace> planes;
    for (const std::uint32_t i : of_faces.of(f)) {
      if (dot(of_faces[i].normal, of_faces[i].normal) > 0) planes.push_back(of_faces[i]);
    }
    for (std::uint32_t k = 0; k < 3; ++k) {
      Quadric& q = quadrics[mesh.from(3 * f + k)];
      for (const FitPlace& p : planes)
        q.add_plane(p.normal, dot(p.normal, t[k] - p.at), size / 2 / double(planes.size()));
      if (planes.empty()) q.add_plane({n[0] / size, n[1] / size, n[2] / size}, 0, size / 2);
      for (const std::uint32_t i : of_faces.of(f)) {
        const FitPlace& p = of_faces[i];
        if (dot(p.end, p.end) > 0) q.add_plane(p.end, dot(p.end, t[k] - p.at), of_faces.shares(i)[k] * point_area);
      }
    }
  }
  return quadrics;
}

}  // namespace bp
