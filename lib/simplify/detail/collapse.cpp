#include "lib/simplify/detail/collapse.h"

#include <cmath>

namespace bp {

namespace {

/// Returns the quadric of a face's plane, relative to any of its corners, where the plane's offset is zero.
Quadric quadric_of_face(const LatticeCoord& a, const LatticeCoord& b, const LatticeCoord& c) {
  const Vec3d n = to_double(normal_of(a, b, c));
  const double size = length(n);
  Quadric q;
  q.add_plane({n[0] / size, n[1] / size, n[2] / size}, 0, size / 2);
  return q;
}

}  // namespace

std::vector<Quadric> quadrics_of(const HalfEdgeMesh& mesh) {
  std::vector<Quadric> quadrics(mesh.vertex_capacity());
  for (FaceId f = 0; f < mesh.face_capacity(); ++f) {
    if (!mesh.alive(f)) continue;
    const Quadric q = quadric_of_face(mesh.corner(f, 0), mesh.corner(f, 1), mesh.corner(f, 2));
    for (HalfEdgeId h = 3 * f; h < 3 * f + 3; ++h) quadrics[mesh.from(h)].add(q);
  }
  return quadrics;
}

std::vector<Quadric> quadrics_of(const Piece& piece) {
  std::vector<Quadric> quadrics(piece.vertices.size());
  for (const auto& [a, b, c] : piece.triangles) {
    const Quadric q = quadric_of_face(piece.vertices[a], piece.vertices[b], piece.vertices[c]);
    for (const VertexId v : {a, b, c}) quadrics[v].add(q);
  }
  return quadrics;
}

Collapser::Collapser(HalfEdgeMesh& mesh, std::vector<Quadric> quadrics, const SimplifyParams& params,
                     SimplifyCounts& counts)
    : mesh_(mesh),
      counts_(counts),
      tree_(mesh),
      quadric_(quadrics.empty() ? quadrics_of(mesh) : std::move(quadrics)),
      ground_{mesh_, tree_, params, quadric_, sense_, intersect(mesh.room(), params.room)} {
  ground_.only_grows = params.dense && !params.free && params.enclosed == nullptr && params.limits == nullptr;
  if (!ground_.only_grows) sense_.emplace(mesh);
  if (params.most_growth > 0 && params.whole.volume6 > 0) {
    ground_.volume6 = params.whole.volume6;
  } else if (params.most_growth > 0 && mesh.cell().min == kEverywhere.min) {
    ground_.volume6 = std::abs(double(mesh.volume6()));
  }
}

void Collapser::count_solved(CollapsePlanner& planner) {
  counts_.solved += planner.solved;
  planner.solved = 0;
}

bool Collapser::take(const CollapsePlan& plan) {
  if (ground_.params.free && sense_->turns(plan.face, plan.gain6)) return false;
  const HalfEdgeId h = plan.edge;
  const VertexId u = mesh_.from(h);
  if (sense_) sense_->add(plan.face, plan.gain6);
  for (const HalfEdgeId g : {h, mesh_.twin(h)}) tree_.remove(HalfEdgeMesh::face(g));
  mesh_.collapse(h, plan.position);
  quadric_[u] = plan.quadric;
  ++counts_.collapses;
  mesh_.for_each_outgoing(u, [&](HalfEdgeId g) { tree_.update(HalfEdgeMesh::face(g)); });
  for (const FaceId f : plan.swallowed) {
    if (mesh_.alive(f)) erase_part(f);
  }
  tree_.maintain();
  return true;
}

void Collapser::erase_part(FaceId f) {
  std::vector<FaceId> stack{f};
  const auto erase = [&](FaceId g) {
    for (HalfEdgeId h = 3 * g; h < 3 * g + 3; ++h) stack.push_back(HalfEdgeMesh::face(mesh_.twin(h)));
    mesh_.erase(g);
    tree_.remove(g);
  };
  while (!stack.empty()) {
    const FaceId g = stack.back();
    stack.pop_back();
    if (mesh_.alive(g)) erase(g);
  }
}

}  // namespace bp
