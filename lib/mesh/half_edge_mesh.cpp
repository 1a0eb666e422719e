#include "lib/mesh/half_edge_mesh.h"

#include <algorithm>

#include "lib/core/error.h"
#include "lib/mesh/lattice_geometry.h"

namespace bp {

HalfEdgeMesh::HalfEdgeMesh(std::vector<LatticeCoord> vertices, std::span<const Triangle> triangles,
                           const LatticeBox& cell)
    : position_(std::move(vertices)),
      out_(position_.size(), kNoId),
      from_(3 * triangles.size()),
      twin_(3 * triangles.size(), kNoId),
      locked_(position_.size(), 0),
      face_count_(triangles.size()),
      cell_(cell),
      origin_(position_.empty() ? LatticeCoord{} : position_[0]) {
  for (std::size_t f = 0; f < triangles.size(); ++f) std::copy_n(triangles[f].begin(), 3, from_.begin() + 3 * f);
  check_span();
  connect();
  check_fans();
}

void HalfEdgeMesh::check_span() const {
  if (position_.empty()) return;
  const LatticeBox box = box_of(position_);
  const LatticeCoord size = box.max - box.min;
  if (std::max({size.x, size.y, size.z}) >= kMaxSpan)
    fail(ErrorCode::failed, {Remedy::larger_voxels}, "the surface spans {} lattice units, more than 2^29",
         std::max({size.x, size.y, size.z}));
}

LatticeBox HalfEdgeMesh::room() const {
  constexpr std::int64_t kBeyond = kMaxSpan / 2;
  const LatticeCoord margin{kBeyond, kBeyond, kBeyond};
  const LatticeBox box = box_of(position_);
  return intersect({box.min - margin, box.max + margin}, cell_);
}

/// Finds the twins. Half-edges go to buckets by their lower vertex and are sorted by the higher one: no hashing, linear
/// but for the logarithm of the valence.
void HalfEdgeMesh::connect() {
  struct Half {
    VertexId high;  // the higher end
    HalfEdgeId h;
  };
  const auto edges = HalfEdgeId(from_.size());
  // One more than needed: each entry is the cursor while its bucket fills.
  std::vector<std::uint32_t> start(position_.size() + 2, 0);
  for (HalfEdgeId h = 0; h < edges; ++h) {
    ++start[std::min(from(h), to(h)) + 2];
    out_[from(h)] = h;
  }
  for (std::size_t v = 0; v < position_.size(); ++v) start[v + 2] += start[v + 1];
  std::vector<Half> bucket(from_.size());
  for (HalfEdgeId h = 0; h < edges; ++h) {
    const VertexId low = std::min(from(h), to(h)), high = std::max(from(h), to(h));
    bucket[start[low + 1]++] = {high, h};
  }
  for (VertexId v = 0; v < position_.size(); ++v) {
    std::sort(bucket.begin() + start[v], bucket.begin() + start[v + 1],
              [](const Half& a, const Half& b) { return a.high != b.high ? a.high < b.high : a.h < b.h; });
    for (std::uint32_t i = start[v]; i < start[v + 1]; ++i) {
      const auto [high, h] = bucket[i];
      for (std::uint32_t j = i + 1; j < start[v + 1] && bucket[j].high == high && twin_[h] == kNoId; ++j) {
        const HalfEdgeId g = bucket[j].h;
        if (twin_[g] == kNoId && from(h) != from(g)) glue(h, g);
      }
      if (twin_[h] != kNoId) continue;
      locked_[from(h)] = locked_[to(h)] = 1;
      if (cell_.holds_inside(position_[from(h)]) || cell_.holds_inside(position_[to(h)]))
        fail(ErrorCode::failed, "the surface is not closed at vertex {}", v);
    }
  }
}

void HalfEdgeMesh::check_fans() {
  std::vector<std::uint32_t> degree(position_.size(), 0);
  for (const VertexId v : from_) ++degree[v];
  for (VertexId v = 0; v < position_.size(); ++v) {
    if (out_[v] == kNoId || locked(v) || std::uint32_t(valence(v)) == degree[v]) continue;
    locked_[v] = 1;  // the fan leaves the cell and comes back
    if (cell_.holds_inside(position_[v])) fail(ErrorCode::failed, "the surface is not 2-manifold at vertex {}", v);
  }
}

int HalfEdgeMesh::valence(VertexId v) const {
  int n = 0;
  for_each_outgoing(v, [&](HalfEdgeId) { ++n; });
  return n;
}

int128 HalfEdgeMesh::volume6() const {
  int128 sum = 0;
  for (FaceId f = 0; f < face_capacity(); ++f) {
    if (alive(f)) sum += orient3d_value(origin_, corner(f, 0), corner(f, 1), corner(f, 2));
  }
  return sum;
}

// The ends have two common neighbours: the apices of the edge's faces. If an apex has valence 3, they have another one;
// or else the four vertices are a tetrahedron, and both ends have valence 3 themselves.
bool HalfEdgeMesh::can_collapse(HalfEdgeId h) const {
  const VertexId u = from(h), w = to(h);
  if (locked(u) || locked(w) || opposite(h) == opposite(twin(h))) return false;
  constexpr int kChunk = 16;  // neighbours of u that one round about w looks for
  VertexId near[kChunk];
  int common = 0, n = 0;
  const auto count_common = [&] {
    for_each_outgoing(w, [&](HalfEdgeId g) { common += int(std::count(near, near + n, to(g))); });
    n = 0;
  };
  for_each_outgoing(u, [&](HalfEdgeId g) {
    near[n++] = to(g);  // w itself is no neighbour of w
    if (n == kChunk) count_common();
  });
  count_common();
  return common == 2 && !(valence(u) == 3 && valence(w) == 3);
}

void HalfEdgeMesh::collapse(HalfEdgeId h, const LatticeCoord& p) {
  const HalfEdgeId t = twin(h);
  const VertexId u = from(h), w = to(h), a = opposite(h), b = opposite(t);
  const HalfEdgeId a_left = twin(prev(h)), a_right = twin(next(h)), b_left = twin(prev(t)), b_right = twin(next(t));
  for_each_outgoing(w, [&](HalfEdgeId g) { from_[g] = u; });
  glue(a_left, a_right);  // u -> a and a -> u
  glue(b_left, b_right);
  // a_right was the twin of w -> a, so it leaves a; b_left was the twin of b -> w, so it leaves u. The two others do
  // not exist if u is locked and its edge to a or b lies in the rim.
  out_[u] = b_left;
  out_[a] = a_right;
  out_[b] = next(b_left);
  out_[w] = kNoId;
  for (const FaceId f : {face(h), face(t)}) {
    for (std::uint32_t k = 0; k < 3; ++k) from_[3 * f + k] = kNoId;
  }
  face_count_ -= 2;
  position_[u] = p;
}

bool HalfEdgeMesh::are_joined(VertexId v, VertexId w) const {
  bool joined = false;
  for_each_outgoing(v, [&](HalfEdgeId h) { joined |= to(h) == w; });
  return joined;
}

bool HalfEdgeMesh::can_flip(HalfEdgeId h) const {
  if (twin(h) == kNoId) return false;
  const VertexId a = opposite(h), b = opposite(twin(h));
  for (const VertexId v : {from(h), to(h), a, b}) {
    if (locked(v)) return false;
  }
  return a != b && valence(from(h)) > 3 && valence(to(h)) > 3 && !are_joined(a, b);
}

void HalfEdgeMesh::flip(HalfEdgeId h) {
  // Faces (u, w, a) and (w, u, b) become (b, a, u) and (a, b, w). Then h runs b -> a, and its twin a -> b.
  const HalfEdgeId t = twin(h);
  const VertexId u = from(h), w = to(h), a = opposite(h), b = opposite(t);
  const HalfEdgeId wa = twin(next(h)), au = twin(prev(h)), ub = twin(next(t)),
                   bw = twin(prev(t));  // the outer halves, reversed
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

void HalfEdgeMesh::save(VertexId v, Undo& undo) const {
  for_each_outgoing(v, [&](HalfEdgeId out) {
    const HalfEdgeId first = 3 * face(out);
    for (HalfEdgeId h = first; h < first + 3; ++h) {
      undo.halves.push_back({h, from_[h], twin_[h]});
      undo.vertices.push_back({from_[h], position_[from_[h]], out_[from_[h]]});
    }
  });
}

void HalfEdgeMesh::restore(const Undo& undo) {
  for (std::size_t i = undo.halves.size(); i-- > 0;) {  // what was saved first is put back last
    const auto& [h, from, twin] = undo.halves[i];
    from_[h] = from;
    twin_[h] = twin;
    const auto& [v, position, out] = undo.vertices[i];
    position_[v] = position;
    out_[v] = out;
  }
  face_count_ = undo.face_count;
}

void HalfEdgeMesh::erase(FaceId f) {
  for (HalfEdgeId h = 3 * f; h < 3 * f + 3; ++h) {
    out_[from_[h]] = kNoId;
    from_[h] = kNoId;
  }
  --face_count_;
}

LatticeMesh HalfEdgeMesh::compact(const GridFrame& frame) const {
  LatticeMesh mesh;
  mesh.frame = frame;
  mesh.triangles = live_faces([&](VertexId v, VertexId) { mesh.vertices.push_back(position_[v]); });
  return mesh;
}

Vec3d vertex_normal(const HalfEdgeMesh& mesh, VertexId v) {
  Vec3d n{};
  mesh.for_each_outgoing(v, [&](HalfEdgeId h) {
    n = n + to_double(normal_of(mesh.position(v), mesh.position(mesh.to(h)), mesh.position(mesh.opposite(h))));
  });
  const double l = length(n);
  return l > 0 ? Vec3d{n[0] / l, n[1] / l, n[2] / l} : n;
}

}  // namespace bp
