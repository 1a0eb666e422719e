#include "lib/fit/fit.h"

#include <algorithm>

#include "lib/core/parallel.h"
#include "lib/core/vec3.h"
#include "lib/fit/detail/face_points.h"
#include "lib/fit/detail/settle.h"
#include "lib/fit/detail/vertex_mover.h"
#include "lib/geometry/spread.h"
#include "lib/geometry/triangle_bvh.h"
#include "lib/mesh/shells.h"

namespace bp {

namespace {

constexpr std::uint64_t kFineFactor = 10, kFineFaces = 20000;
constexpr std::uint64_t kPointsPerFace = 30, kLeastPoints = 30000;
constexpr double kLongest = 2.5;  // longest edge, over the square root of a face's share of the area
constexpr int kSweeps = 4, kRounds = 7;

/// Returns the middles of about `share` of the faces, all of which have the same size. A hash of the place chooses
/// them.
std::vector<FitPlace> spread_points(const SurfaceSource& dense, double share) {
  const std::vector<BrickCoord> bricks = dense.bricks();
  std::vector<std::vector<FitPlace>> chosen(bricks.size());
  parallel_for(std::int64_t(bricks.size()), [&](std::int64_t i) {
    const Piece piece = dense.piece(bricks[std::size_t(i)]);
    for (const auto& t : piece.triangles) {
      const LatticeCoord sum = piece.vertices[t[0]] + piece.vertices[t[1]] + piece.vertices[t[2]];
      if (is_among(sum, share)) chosen[std::size_t(i)].push_back({1.0 / 3 * to_double(sum)});
    }
  });
  std::vector<FitPlace> points;
  for (const auto& some : chosen) points.insert(points.end(), some.begin(), some.end());
  return points;
}

/// Smoothed normals of a surface, interpolated between its vertices.
class SmoothNormals {
 public:
  explicit SmoothNormals(const HalfEdgeMesh& mesh) {
    for (FaceId f = 0; f < mesh.face_capacity(); ++f) {
      if (!mesh.alive(f)) continue;
      triangles_.push_back({to_double(mesh.corner(f, 0)), to_double(mesh.corner(f, 1)), to_double(mesh.corner(f, 2))});
      normals_.push_back({vertex_normal(mesh, mesh.from(3 * f)), vertex_normal(mesh, mesh.from(3 * f + 1)),
                          vertex_normal(mesh, mesh.from(3 * f + 2))});
    }
    tree_ = std::make_unique<TriangleBvh>(triangles_);
  }

  /// Returns the normal at the surface point nearest to `p`. `guess`: as for TriangleBvh::nearest().
  [[nodiscard]] Vec3d at(const Vec3d& p, std::uint32_t& guess) const {
    guess = tree_->nearest(p, guess).item;
    const TriangleBvh::Item& item = tree_->item(guess);
    const std::array<double, 3> share = barycentric(item.corners, nearest_point(p, item.corners));
    const std::array<Vec3d, 3>& n = normals_[item.id];
    const Vec3d sum = share[0] * n[0] + share[1] * n[1] + share[2] * n[2];
    const double l = length(sum);
    return l > 0 ? 1 / l * sum : sum;
  }

 private:
  std::vector<TriangleD> triangles_;
  std::vector<std::array<Vec3d, 3>> normals_;
  std::unique_ptr<TriangleBvh> tree_;
};

void move_to_targets(std::vector<FitPlace>& points, const HalfEdgeMesh& surface, const FitTarget& target) {
  const SmoothNormals normals(surface);
  parallel_ranges(std::int64_t(points.size()), kItemsAtOnce, [&](std::int64_t begin, std::int64_t end) {
    std::uint32_t guess = 0;
    for (auto i = std::size_t(begin); i < std::size_t(end); ++i)
      points[i] = target(points[i].at, normals.at(points[i].at, guess));
  });
}

/// Collapses edges down to params.faces. If params.reach stops it before, it goes on with a longer reach, and leaves
/// that in `params`.
LatticeMesh collapsed(const FineFit& fine, SimplifyParams& params, SimplifyCounts& counts) {
  const double first = params.reach;
  LatticeMesh level = simplify(fine.surface, fine.quadrics, params, counts);
  while (params.reach > 0 && counts.stop != StopReason::faces && counts.refused[Refusal::growth] > 0) {
    params.reach = loosened(params.reach, first);
    SimplifyCounts now;
    level = simplify(level, quadrics_of_points(HalfEdgeMesh(level), fine.points, fine.point_area), params, now);
    counts.add(now);
  }
  return level;
}

}  // namespace

std::uint64_t draw_to_targets(HalfEdgeMesh& mesh, const FitTarget& target, const EdgeLimit& edge_limit, int sweeps) {
  ShapeLimits shape;
  shape.edge_limit = edge_limit;
  VertexMover mover(mesh, shape, nullptr);
  std::vector<LatticeCoord> targets(mesh.vertex_capacity());
  for (VertexId v = 0; v < mesh.vertex_capacity(); ++v) {  // all targets are computed before a vertex moves: no drift
    if (mesh.vertex_alive(v)) targets[v] = rounded(target(to_double(mesh.position(v)), vertex_normal(mesh, v)).at);
  }
  std::uint64_t moves = 0;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (VertexId v = 0; v < mesh.vertex_capacity(); ++v) {
      if (mesh.vertex_alive(v)) moves += mover.draw(v, targets[v]);
    }
  }
  return moves;
}

FineFit fine_fit(const SurfaceSource& dense, std::uint64_t faces, const FitTarget& target, const EdgeLimit& edge_limit,
                 const PieceMemory& memory) {
  SimplifyParams params;
  params.faces = std::max(kFineFactor * faces, kFineFaces);
  params.free = true;
  params.memory = memory;
  const auto dense_faces = double(count_faces(dense));
  constexpr double kAreaOfFace = kLatticePerVoxel * kLatticePerVoxel / 2.0;
  // The flat steps of a voxelized curved surface keep some inner vertices, since these are moved onto the curved
  // surface later.
  const EdgeLimit keep = edges_up_to(
      std::max(2.0 * kLatticePerVoxel, kLongest * std::sqrt(kAreaOfFace * dense_faces / double(params.faces))));
  params.edge_limit = [&](const LatticeCoord& a, const LatticeCoord& b) {
    return keep(a, b) && (!edge_limit || edge_limit(a, b));
  };
  SimplifyCounts counts;
  HalfEdgeMesh mesh(simplify(dense, params, counts));
  FineFit fine;
  fine.points = spread_points(dense, double(std::max(kPointsPerFace * faces, kLeastPoints)) / dense_faces);
  fine.point_area = kAreaOfFace * dense_faces / double(std::max<std::size_t>(fine.points.size(), 1));
  move_to_targets(fine.points, mesh, target);
  draw_to_targets(mesh, target, edge_limit, kSweeps);
  erase_inner_shells(mesh);
  fine.surface = mesh.compact(dense.frame());
  fine.quadrics = quadrics_of_points(HalfEdgeMesh(fine.surface), fine.points, fine.point_area);
  return fine;
}

LatticeMesh fit_level(const FineFit& fine, const SimplifyParams& params, SimplifyCounts& counts) {
  SimplifyParams free = params;
  free.free = true;
  free.dense = false;
  const LatticeMesh level = collapsed(fine, free, counts);
  HalfEdgeMesh mesh(level);
  settle(mesh, fine.points, free, kRounds);
  erase_inner_shells(mesh);  // shells that other parts have moved over without touching them
  counts.faces_out = mesh.face_count();
  LatticeMesh out = mesh.compact(level.frame);
  out.provenance = level.provenance;
  return out;
}

}  // namespace bp
