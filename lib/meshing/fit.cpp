#include "lib/meshing/fit.h"

#include <algorithm>

#include "lib/meshing/guard.h"

namespace bp {

namespace {

constexpr std::uint64_t kFineFactor = 10, kFineFaces = 20000;
constexpr double kLongest = 2.5;  // edges, times the square root of a face's share of the area
constexpr int kSweeps = 4;
constexpr double kQualityFloor = 0.05;
constexpr double kLeastTurn = 0.3;  // cosine between a face's normal before and after

/// Moves vertices, each move checked.
class Mover {
 public:
  explicit Mover(HalfEdgeMesh& mesh) : mesh_(mesh), tree_(mesh), guard_(mesh, tree_) {}

  /// Unit normal by area; zero if the areas cancel.
  [[nodiscard]] Vec3d normal(VertexId v) const {
    Vec3d sum{};
    mesh_.for_each_outgoing(v, [&](HalfEdgeId h) {
      const Vec3d n =
          to_double(normal_of(mesh_.position(v), mesh_.position(mesh_.to(h)), mesh_.position(mesh_.opposite(h))));
      for (std::size_t i = 0; i < 3; ++i) sum[i] += n[i];
    });
    const double l = length(sum);
    if (l > 0) {
      for (double& x : sum) x /= l;
    }
    return sum;
  }

  bool try_move(VertexId v, const LatticeCoord& q) {
    star_.clear();
    replaced_.clear();
    bool fine = true;
    double before = 1, after = 1;
    const LatticeCoord p = mesh_.position(v);
    mesh_.for_each_outgoing(v, [&](HalfEdgeId h) {
      const LatticeCoord a = mesh_.position(mesh_.to(h)), b = mesh_.position(mesh_.opposite(h));
      const Vec3d n0 = to_double(normal_of(p, a, b)), n1 = to_double(normal_of(q, a, b));
      const double l1 = dot(n1, n1);
      fine = fine && l1 > 0 && dot(n0, n1) > kLeastTurn * std::sqrt(dot(n0, n0) * l1);
      before = std::min(before, triangle_quality(p, a, b));
      after = std::min(after, triangle_quality(q, a, b));
      star_.push_back({{v, mesh_.to(h), mesh_.opposite(h)}, {q, a, b}});
      replaced_.push_back(HalfEdgeMesh::face(h));
    });
    if (!fine || after < std::min(kQualityFloor, before) || !guard_.star_is_free(star_, replaced_)) return false;
    mesh_.move(v, q);
    for (const FaceId f : replaced_) tree_.update(f);
    return true;
  }

 private:
  HalfEdgeMesh& mesh_;
  FaceTree tree_;
  Guard guard_;
  std::vector<NewFace> star_;
  std::vector<FaceId> replaced_;
};

LatticeCoord part_of_way(const LatticeCoord& p, const LatticeCoord& q, double share) {
  return {p.x + std::llround(share * double(q.x - p.x)), p.y + std::llround(share * double(q.y - p.y)),
          p.z + std::llround(share * double(q.z - p.z))};
}

}  // namespace

std::uint64_t draw_to_targets(HalfEdgeMesh& mesh, const FitTarget& target, int sweeps) {
  Mover mover(mesh);
  std::vector<LatticeCoord> targets(mesh.vertex_capacity());
  for (VertexId v = 0; v < mesh.vertex_capacity(); ++v) {  // all from where the surface is now: no drift
    if (mesh.vertex_alive(v)) targets[v] = target(mesh.position(v), mover.normal(v));
  }
  std::uint64_t moves = 0;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (VertexId v = 0; v < mesh.vertex_capacity(); ++v) {
      if (!mesh.vertex_alive(v)) continue;
      for (const double share : {1.0, 0.5, 0.25}) {
        const LatticeCoord p = mesh.position(v), q = part_of_way(p, targets[v], share);
        if (q == p) break;
        if (!mover.try_move(v, q)) continue;
        ++moves;
        break;
      }
    }
  }
  return moves;
}

LatticeMesh fine_fit(const SurfaceSource& dense, std::uint64_t faces, const FitTarget& target,
                     const PieceMemory& memory) {
  SimplifyParams params;
  params.faces = std::max(kFineFactor * faces, kFineFaces);
  params.free = true;
  params.memory = memory;
  constexpr double kAreaOfFace = kLatticePerVoxel * kLatticePerVoxel / 2.0;
  const double area = kAreaOfFace * double(count_faces(dense));
  // Flat steps of a curved surface must keep vertices inside, to be drawn onto it.
  const double limit = std::max(2.0 * kLatticePerVoxel, kLongest * std::sqrt(area / double(params.faces)));
  params.edge_limit = [limit](const LatticeCoord&) { return limit; };
  SimplifyCounts counts;
  const LatticeMesh fine = simplify(dense, params, counts);
  HalfEdgeMesh mesh(fine);
  draw_to_targets(mesh, target, kSweeps);
  return mesh.compact(dense.frame());
}

LatticeMesh fit_level(const LatticeMesh& fine, const SimplifyParams& params, SimplifyCounts& counts) {
  SimplifyParams free = params;
  free.free = true;
  free.dense = false;
  return simplify(fine, free, counts);
}

}  // namespace bp
