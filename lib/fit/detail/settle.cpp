#include "lib/fit/detail/settle.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lib/core/parallel.h"
#include "lib/core/vec3.h"
#include "lib/fit/detail/vertex_mover.h"
#include "lib/geometry/triangle_bvh.h"
#include "lib/mesh/constrained_minimum.h"

namespace bp {

namespace {

constexpr std::int64_t kGrain = 256;  // points per work item
constexpr double kSlide = 0.1;        // weight of a point's distance along its face, against that across it
constexpr double kStay = 0.02;        // of a vertex's own place, against that of its points together

/// A point and the place nearest to it: of a face, by the shares of its corners.
struct Pull {
  FaceId face = 0;
  std::array<double, 3> share{};
};

class Settler {
 public:
  Settler(HalfEdgeMesh& mesh, std::span<const Vec3d> points, const EdgeLimit& edge_limit, StepLimits* limits)
      : mesh_(mesh), mover_(mesh, edge_limit, limits), points_(points) {}

  std::uint64_t round() {
    assign();
    std::uint64_t moves = 0;
    for (VertexId v = 0; v < mesh_.vertex_capacity(); ++v) {
      if (!mesh_.vertex_alive(v)) continue;
      const Vec3d d = wanted_step(v);
      const LatticeCoord& p = mesh_.position(v);
      moves += mover_.draw(v, p + rounded(d));
    }
    return moves;
  }

 private:
  /// Each point to the face nearest to it; points by face.
  void assign() {
    std::vector<TriangleD> triangles;
    std::vector<FaceId> faces;
    for (FaceId f = 0; f < mesh_.face_capacity(); ++f) {
      if (!mesh_.alive(f)) continue;
      triangles.push_back(triangle(f));
      faces.push_back(f);
    }
    const TriangleBvh tree(triangles);
    pulls_.resize(points_.size());
    parallel_ranges(std::int64_t(points_.size()), kGrain, [&](std::int64_t begin, std::int64_t end) {
      std::uint32_t guess = 0;
      for (auto i = std::size_t(begin); i < std::size_t(end); ++i) {
        guess = tree.nearest(points_[i], guess).item;
        const TriangleBvh::Item& item = tree.item(guess);
        pulls_[i] = {faces[item.id], barycentric(item.corners, nearest_point(points_[i], item.corners))};
      }
    });
    begin_.assign(mesh_.face_capacity() + 1, 0);
    for (const Pull& pull : pulls_) ++begin_[pull.face + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    order_.resize(points_.size());
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    for (std::uint32_t i = 0; i < pulls_.size(); ++i) order_[next[pulls_[i].face]++] = i;
  }

  /// Where v would be best, its neighbours standing still; from where it is.
  [[nodiscard]] Vec3d wanted_step(VertexId v) const {
    Quadric q;
    mesh_.for_each_outgoing(v, [&](HalfEdgeId h) { add_points(HalfEdgeMesh::face(h), int(h % 3), q); });
    if (q.weight == 0) return {};
    for (const Vec3d& axis : kAxes) q.add_plane(axis, 0, kStay * q.weight);
    return minimum(q, {});
  }

  void add_points(FaceId f, int corner, Quadric& q) const {
    const TriangleD t = triangle(f);
    Vec3d n = cross(t[1] - t[0], t[2] - t[0]);
    n = 1 / length(n) * n;
    for (std::uint32_t k = begin_[f]; k < begin_[f + 1]; ++k) {
      const std::array<double, 3>& s = pulls_[order_[k]].share;
      const double own = s[std::size_t(corner)];
      const Vec3d off = points_[order_[k]] - (s[0] * t[0] + s[1] * t[1] + s[2] * t[2]);
      q.add_plane(own * n, -dot(n, off), 1);
      for (std::size_t i = 0; i < 3; ++i) q.add_plane(own * kAxes[i], -off[i], kSlide);
    }
  }

  [[nodiscard]] TriangleD triangle(FaceId f) const {
    return {to_double(mesh_.corner(f, 0)), to_double(mesh_.corner(f, 1)), to_double(mesh_.corner(f, 2))};
  }

  static constexpr std::array<Vec3d, 3> kAxes{Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};

  HalfEdgeMesh& mesh_;
  VertexMover mover_;
  std::span<const Vec3d> points_;
  std::vector<Pull> pulls_;                   // per point
  std::vector<std::uint32_t> begin_, order_;  // per face: a range of point numbers
};

}  // namespace

std::uint64_t settle(HalfEdgeMesh& mesh, std::span<const Vec3d> points, const EdgeLimit& edge_limit, StepLimits* limits,
                     int rounds) {
  Settler settler(mesh, points, edge_limit, limits);
  std::uint64_t moves = 0;
  for (int i = 0; i < rounds; ++i) moves += settler.round();
  return moves;
}

}  // namespace bp
