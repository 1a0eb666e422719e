#include "lib/fit/detail/settle.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "lib/core/vec3.h"
#include "lib/fit/detail/face_points.h"
#include "lib/fit/detail/vertex_mover.h"
#include "lib/geometry/triangle_bvh.h"
#include "lib/mesh/constrained_minimum.h"

namespace bp {

namespace {

// Weight of a point's distance along its face, over the weight of its distance across it.
constexpr double kSlide = 0.1;
constexpr double kStay = 0.02;  // weight of a vertex's old place, over the weight of all its points together
// A face is held to a plane of the scene if this share of its points lies in the plane, within this angle (cosine) and
// distance.
constexpr double kMostPoints = 0.7, kSameNormal = 0.996, kSamePlane = 0.1 * kLatticePerVoxel;
constexpr std::size_t kMostCandidates = 16;
constexpr double kFlipGain = 0.1;  // a flip must save this share of the squared distances of the points of both faces
constexpr int kRoundsPerFlips = 3;

class Settler {
 public:
  Settler(HalfEdgeMesh& mesh, std::span<const FitPlace> points, const SimplifyParams& params)
      : mesh_(mesh), mover_(mesh, params, params.enclosed), points_(points) {}

  std::uint64_t round() {
    points_.assign(mesh_);
    if (++rounds_ % kRoundsPerFlips == 0 && flip_edges() > 0) points_.assign(mesh_);
    find_planes();
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
  /// Flips edges so that they run along the edges of the scene. Each face changes at most once.
  std::uint64_t flip_edges() {
    std::uint64_t flips = 0;
    std::vector<char> changed(mesh_.face_capacity(), 0);
    for (HalfEdgeId h = 0; h < 3 * mesh_.face_capacity(); ++h) {
      const FaceId f = HalfEdgeMesh::face(h);
      if (!mesh_.alive(f) || mesh_.edge(h) != h) continue;
      const FaceId g = HalfEdgeMesh::face(mesh_.twin(h));
      if (changed[f] || changed[g] || !gains_by_flip(h) || !mover_.flip(h)) continue;
      changed[f] = changed[g] = 1;
      ++flips;
    }
    return flips;
  }

  [[nodiscard]] bool gains_by_flip(HalfEdgeId h) const {
    const HalfEdgeId t = mesh_.twin(h);
    const auto at = [&](VertexId v) { return to_double(mesh_.position(v)); };
    const Vec3d u = at(mesh_.from(h)), w = at(mesh_.to(h)), a = at(mesh_.opposite(h)), b = at(mesh_.opposite(t));
    const std::array<TriangleD, 2> now{TriangleD{u, w, a}, TriangleD{w, u, b}},
        then{TriangleD{b, a, u}, TriangleD{a, b, w}};
    double before = 0, after = 0;
    for (const HalfEdgeId side : {h, t}) {
      for (const std::uint32_t i : points_.of(HalfEdgeMesh::face(side))) {
        const Vec3d& p = points_[i].at;
        before += distance_squared(p, now[side == h ? 0 : 1]);
        after += std::min(distance_squared(p, then[0]), distance_squared(p, then[1]));
      }
    }
    return after < (1 - kFlipGain) * before;
  }

  void find_planes() {
    planes_.assign(mesh_.face_capacity(), std::nullopt);
    for (FaceId f = 0; f < mesh_.face_capacity(); ++f) {
      if (mesh_.alive(f)) planes_[f] = plane_of(f);
    }
  }

  /// Returns the plane in which most of the face's points lie.
  [[nodiscard]] std::optional<FitPlace> plane_of(FaceId f) const {
    const std::span<const std::uint32_t> points = points_.of(f);
    if (points.empty()) return std::nullopt;
    std::size_t most = 0;
    FitPlace best;
    for (std::size_t k = 0; k < points.size(); k += 1 + points.size() / kMostCandidates) {
      const FitPlace& plane = points_[points[k]];
      const auto votes = std::size_t(
          std::count_if(points.begin(), points.end(), [&](std::uint32_t j) { return is_in(points_[j], plane); }));
      if (votes <= most) continue;
      most = votes;
      best = plane;
    }
    if (double(most) < kMostPoints * double(points.size())) return std::nullopt;
    return best;
  }

  [[nodiscard]] static bool is_in(const FitPlace& p, const FitPlace& plane) {
    return std::abs(dot(p.normal, plane.normal)) > kSameNormal &&
           std::abs(dot(plane.normal, p.at - plane.at)) < kSamePlane;
  }

  /// Returns the step from v's place to the place where v is best while its neighbours stay where they are.
  [[nodiscard]] Vec3d wanted_step(VertexId v) const {
    Quadric q;
    mesh_.for_each_outgoing(v, [&](HalfEdgeId h) {
      const FaceId f = HalfEdgeMesh::face(h);
      if (planes_[f]) {
        add_plane(*planes_[f], v, double(points_.of(f).size()), q);
      }
      add_points(f, int(h % 3), q);
    });
    if (q.weight == 0) return {};
    for (const Vec3d& axis : kAxes) q.add_plane(axis, 0, kStay * q.weight);
    return minimum(q, {});
  }

  void add_plane(const FitPlace& plane, VertexId v, double weight, Quadric& q) const {
    q.add_plane(plane.normal, dot(plane.normal, to_double(mesh_.position(v)) - plane.at), weight);
  }

  void add_points(FaceId f, int corner, Quadric& q) const {
    const std::array<Vec3d, 3> t = corners_of(mesh_, f);
    Vec3d n = cross(t[1] - t[0], t[2] - t[0]);
    n = 1 / length(n) * n;
    for (const std::uint32_t i : points_.of(f)) {
      const bool flat = planes_[f].has_value();
      const Vec3d& end = points_[i].end;
      const bool ends = dot(end, end) > 0;
      if (flat && !ends && !is_in(points_[i], *planes_[f])) continue;
      const std::array<double, 3>& s = points_.shares(i);
      const double own = s[std::size_t(corner)];
      const Vec3d off = points_[i].at - (s[0] * t[0] + s[1] * t[1] + s[2] * t[2]);
      if (ends) q.add_plane(own * end, -dot(end, off), 1);
      if (ends && flat) continue;
      if (!flat) q.add_plane(own * n, -dot(n, off), 1);
      for (std::size_t k = 0; k < 3; ++k) q.add_plane(own * kAxes[k], -off[k], kSlide);
    }
  }

  static constexpr std::array<Vec3d, 3> kAxes{Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};

  HalfEdgeMesh& mesh_;
  VertexMover mover_;
  FacePoints points_;
  int rounds_ = 0;
  std::vector<std::optional<FitPlace>> planes_;  // per face: the plane of the scene that it is held to
};

}  // namespace

std::uint64_t settle(HalfEdgeMesh& mesh, std::span<const FitPlace> points, const SimplifyParams& params, int rounds) {
  Settler settler(mesh, points, params);
  std::uint64_t moves = 0;
  for (int i = 0; i < rounds; ++i) moves += settler.round();
  return moves;
}

}  // namespace bp
