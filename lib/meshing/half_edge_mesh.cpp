#include "lib/meshing/half_edge_mesh.h"

#include <algorithm>

#include "lib/core/error.h"

namespace bp {

HalfEdgeMesh::HalfEdgeMesh(const LatticeMesh& mesh)
    : position_(mesh.vertices),
      out_(mesh.vertices.size(), kNoId),
      from_(3 * mesh.triangles.size()),
      twin_(3 * mesh.triangles.size(), kNoId),
      face_count_(mesh.triangles.size()) {
  // Buckets of half-edges by their lower vertex: linear, no hashing.
  std::vector<std::uint32_t> start(position_.size() + 1, 0);
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) from_[3 * f + k] = mesh.triangles[f][k];
  }
  const auto low = [&](HalfEdgeId h) { return std::min(from(h), to(h)); };
  const auto edges = HalfEdgeId(from_.size());
  for (HalfEdgeId h = 0; h < edges; ++h) ++start[low(h) + 1];
  for (std::size_t v = 0; v < position_.size(); ++v) start[v + 1] += start[v];
  std::vector<HalfEdgeId> bucket(from_.size());
  std::vector<std::uint32_t> cursor(start.begin(), start.end() - 1);
  for (HalfEdgeId h = 0; h < edges; ++h) bucket[cursor[low(h)]++] = h;
  for (std::size_t v = 0; v < position_.size(); ++v) {
    for (std::uint32_t i = start[v]; i < start[v + 1]; ++i) {
      for (std::uint32_t j = i + 1; j < start[v + 1] && twin_[bucket[i]] == kNoId; ++j) {
        if (twin_[bucket[j]] == kNoId && from(bucket[i]) == to(bucket[j]) && to(bucket[i]) == from(bucket[j]))
          glue(bucket[i], bucket[j]);
      }
      if (twin_[bucket[i]] == kNoId) fail(ErrorCode::failed, "the surface is not closed at vertex {}", v);
    }
  }
  std::vector<std::uint32_t> degree(position_.size(), 0);
  for (HalfEdgeId h = 0; h < edges; ++h) {
    out_[from(h)] = h;
    ++degree[from(h)];
  }
  for (VertexId v = 0; v < position_.size(); ++v) {
    if (out_[v] != kNoId && std::uint32_t(valence(v)) != degree[v])
      fail(ErrorCode::failed, "the surface is not 2-manifold at vertex {}", v);
  }
}

int HalfEdgeMesh::valence(VertexId v) const {
  int n = 0;
  for_each_outgoing(v, [&](HalfEdgeId) { ++n; });
  return n;
}

bool HalfEdgeMesh::can_collapse(HalfEdgeId h) const {
  const VertexId u = from(h), w = to(h), a = opposite(h), b = opposite(twin(h));
  if (a == b || valence(a) <= 3 || valence(b) <= 3) return false;
  int common = 0;
  for_each_outgoing(u, [&](HalfEdgeId g) {
    const VertexId n = to(g);
    if (n != w) for_each_outgoing(w, [&](HalfEdgeId k) { common += to(k) == n; });
  });
  return common == 2;
}

void HalfEdgeMesh::collapse(HalfEdgeId h, const LatticeCoord& p) {
  const HalfEdgeId t = twin(h);
  const VertexId u = from(h), w = to(h), a = opposite(h), b = opposite(t);
  const HalfEdgeId a_left = twin(prev(h)), a_right = twin(next(h)), b_left = twin(prev(t)), b_right = twin(next(t));
  for_each_outgoing(w, [&](HalfEdgeId g) { from_[g] = u; });
  glue(a_left, a_right);  // u -> a and a -> u
  glue(b_left, b_right);
  // a_left was the twin of a -> u, so it leaves u; a_right was the twin of w -> a, so it leaves a. The same for b.
  out_[u] = a_left;
  out_[a] = a_right;
  out_[b] = b_right;
  out_[w] = kNoId;
  for (const FaceId f : {face(h), face(t)}) {
    for (std::uint32_t k = 0; k < 3; ++k) from_[3 * f + k] = kNoId;
  }
  face_count_ -= 2;
  position_[u] = p;
}

bool HalfEdgeMesh::can_flip(HalfEdgeId h) const {
  const VertexId a = opposite(h), b = opposite(twin(h));
  if (a == b || valence(from(h)) <= 3 || valence(to(h)) <= 3) return false;
  bool exists = false;
  for_each_outgoing(a, [&](HalfEdgeId g) { exists |= to(g) == b; });
  return !exists;
}

void HalfEdgeMesh::flip(HalfEdgeId h) {
  // Faces (u, w, a) and (w, u, b) become (b, a, u)... written so that h runs b -> a and its twin a -> b.
  const HalfEdgeId t = twin(h);
  const VertexId u = from(h), w = to(h), a = opposite(h), b = opposite(t);
  const HalfEdgeId wa = twin(next(h)), au = twin(prev(h)), ub = twin(next(t)),
                   bw = twin(prev(t));  // outer halves, reversed
  from_[h] = b;
  from_[next(h)] = a;
  from_[prev(h)] = u;  // face (b, a, u): halves b->a, a->u, u->b
  from_[t] = a;
  from_[next(t)] = b;
  from_[prev(t)] = w;  // face (a, b, w): halves a->b, b->w, w->a
  glue(next(h), au);
  glue(prev(h), ub);
  glue(next(t), bw);
  glue(prev(t), wa);
  out_[u] = prev(h);
  out_[w] = prev(t);
  out_[a] = t;
  out_[b] = h;
}

LatticeMesh HalfEdgeMesh::compact(const GridFrame& frame) const {
  LatticeMesh mesh;
  mesh.frame = frame;
  std::vector<std::uint32_t> id(position_.size(), kNoId);
  for (VertexId v = 0; v < position_.size(); ++v) {
    if (!vertex_alive(v)) continue;
    id[v] = std::uint32_t(mesh.vertices.size());
    mesh.vertices.push_back(position_[v]);
  }
  mesh.triangles.reserve(face_count_);
  for (FaceId f = 0; f < face_capacity(); ++f) {
    if (alive(f)) mesh.triangles.push_back({id[from_[3 * f]], id[from_[3 * f + 1]], id[from_[3 * f + 2]]});
  }
  return mesh;
}

}  // namespace bp
