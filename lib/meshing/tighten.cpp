// With the others fixed, the volume is linear in one vertex: it falls fastest against the area vector of its link. A
// step is tried that way and, where something blocks it, in directions scattered around it (so that vertices slide
// along what blocks them); each vertex keeps its own step length, doubled after success, halved after failure.
#include "lib/meshing/tighten.h"

#include <algorithm>
#include <cmath>

#include "lib/core/predicates.h"
#include "lib/meshing/face_tree.h"
#include "lib/meshing/half_edge_mesh.h"

namespace bp {

namespace {

constexpr double kQualityFloor = 0.08;
constexpr int kDirections = 5;

/// Small deterministic generator, one stream per (vertex, sweep, try).
class Scatter {
 public:
  Scatter(std::uint64_t a, std::uint64_t b) : state_(a * 0x9e3779b97f4a7c15u + b * 0xbf58476d1ce4e5b9u) {}
  double next() {  // in [-1, 1)
    state_ += 0x9e3779b97f4a7c15u;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return double(std::int64_t(z ^ (z >> 31)) >> 11) * 0x1p-52;
  }

 private:
  std::uint64_t state_;
};

class Tightener {
 public:
  Tightener(HalfEdgeMesh& mesh, const Enclosed& enclosed, const TightenParams& params, TightenCounts& counts)
      : mesh_(mesh),
        enclosed_(enclosed),
        params_(params),
        counts_(counts),
        tree_(mesh),
        guard_(mesh, tree_),
        step_(mesh.vertex_capacity(), 0) {}

  void run() {
    counts_.volume_before = volume();
    double last = counts_.volume_before;
    for (int sweep = 0; sweep < params_.sweeps; ++sweep) {
      for (VertexId v = 0; v < mesh_.vertex_capacity(); ++v) {
        if (mesh_.vertex_alive(v)) move_vertex(v, std::uint64_t(sweep));
      }
      for (HalfEdgeId h = 0; h < 3 * mesh_.face_capacity(); ++h) {
        if (mesh_.alive(HalfEdgeMesh::face(h)) && mesh_.edge(h) == h) flip_edge(h);
      }
      if (sweep % 8 == 7) tree_.rebuild();  // boxes only grow; after some sweeps a fresh tree pays
      ++counts_.sweeps;
      const double now = volume();
      if (last - now < params_.least_gain * std::abs(last)) break;
      last = now;
    }
    counts_.volume_after = volume();
  }

 private:
  [[nodiscard]] double volume() const {
    double sum = 0;
    const LatticeCoord o = mesh_.corner(first_face(), 0);
    for (FaceId f = 0; f < mesh_.face_capacity(); ++f) {
      if (mesh_.alive(f)) sum += double(orient3d_value(o, mesh_.corner(f, 0), mesh_.corner(f, 1), mesh_.corner(f, 2)));
    }
    return sum / 6;
  }
  [[nodiscard]] FaceId first_face() const {
    FaceId f = 0;
    while (!mesh_.alive(f)) ++f;
    return f;
  }

  void move_vertex(VertexId v, std::uint64_t sweep) {
    const LatticeCoord p = mesh_.position(v);
    Vec3d down{};  // against the area vector of the link, which is the gradient of the volume times 6
    double edges = 0, least_quality = 1;
    int n = 0;
    mesh_.for_each_outgoing(v, [&](HalfEdgeId h) {
      const LatticeCoord a = mesh_.position(mesh_.to(h)), b = mesh_.position(mesh_.opposite(h));
      const Vec3d area = to_double(normal_of(p, a, b));
      for (std::size_t i = 0; i < 3; ++i) down[i] -= area[i];
      edges += length(to_double(a - p));
      least_quality = std::min(least_quality, triangle_quality(p, a, b));
      ++n;
    });
    const double size = length(down);
    if (size == 0) return;
    for (double& d : down) d /= size;
    double& step = step_[v];
    if (step == 0) step = edges / n / 4;
    if (step < 1) step = 1;
    Scatter scatter(v, sweep);
    for (int i = 0; i < kDirections; ++i) {
      Vec3d d = down;
      if (i > 0) {
        for (double& x : d) x += 1.2 * scatter.next();
        const double l = length(d);
        const double along = (d[0] * down[0] + d[1] * down[1] + d[2] * down[2]) / l;
        if (along < 0.05) continue;
        for (double& x : d) x /= l;
      }
      const LatticeCoord q{p.x + std::llround(step * d[0]), p.y + std::llround(step * d[1]),
                           p.z + std::llround(step * d[2])};
      if (q != p && try_move(v, q, least_quality)) {
        ++counts_.moves;
        step *= 2;
        return;
      }
    }
    step *= 0.5;
  }

  bool try_move(VertexId v, const LatticeCoord& q, double least_quality) {
    ++counts_.tries;
    star_.clear();
    replaced_.clear();
    swept_.clear();
    double gain = 0, after = 1, longest = 0;
    mesh_.for_each_outgoing(v, [&](HalfEdgeId h) {
      const LatticeCoord p = mesh_.position(v), a = mesh_.position(mesh_.to(h)), b = mesh_.position(mesh_.opposite(h));
      star_.push_back({{v, mesh_.to(h), mesh_.opposite(h)}, {q, a, b}});
      replaced_.push_back(HalfEdgeMesh::face(h));
      const int128 grown = orient3d_value(p, a, b, q);  // negative: the tetrahedron leaves the solid
      if (grown < 0) swept_.push_back({p, a, b, q});
      gain -= double(grown);
      after = std::min(after, triangle_quality(q, a, b));
      longest = std::max(longest, length(to_double(a - q)));
    });
    if (gain <= 0 || after < std::min(kQualityFloor, least_quality) || after == 0) return false;
    if (params_.edge_limit && longest > params_.edge_limit(q)) return false;
    if (!enclosed_.allows(star_, swept_) || !guard_.star_is_free(star_, replaced_)) return false;
    if (!within_limits(params_.limits, mesh_, replaced_, star_)) return false;
    mesh_.move(v, q);
    for (const FaceId f : replaced_) tree_.update(f);
    return true;
  }

  void flip_edge(HalfEdgeId h) {
    const HalfEdgeId t = mesh_.twin(h);
    const VertexId u = mesh_.from(h), w = mesh_.to(h), a = mesh_.opposite(h), b = mesh_.opposite(t);
    const LatticeCoord pu = mesh_.position(u), pw = mesh_.position(w), pa = mesh_.position(a), pb = mesh_.position(b);
    if (orient3d(pu, pw, pa, pb) >= 0) return;  // only a convex edge: its flip cuts a tetrahedron off the solid
    flip_to(h, {u, w, a, b}, {pu, pw, pa, pb});
  }

  void flip_to(HalfEdgeId h, const std::array<VertexId, 4>& id, const Tetrahedron& p) {
    const double before = std::min(triangle_quality(p[0], p[1], p[2]), triangle_quality(p[1], p[0], p[3]));
    const double after = std::min(triangle_quality(p[3], p[2], p[0]), triangle_quality(p[2], p[3], p[1]));
    if (after < std::min(kQualityFloor, before) || after == 0 || !mesh_.can_flip(h)) return;
    if (params_.edge_limit && length(to_double(p[3] - p[2])) > params_.edge_limit(p[2])) return;
    const std::array<NewFace, 2> faces = {NewFace{{id[3], id[2], id[0]}, {p[3], p[2], p[0]}},
                                          NewFace{{id[2], id[3], id[1]}, {p[2], p[3], p[1]}}};
    const std::array<FaceId, 2> replaced = {HalfEdgeMesh::face(h), HalfEdgeMesh::face(mesh_.twin(h))};
    const std::array<Tetrahedron, 1> swept = {p};
    if (!enclosed_.allows(faces, swept) || !guard_.faces_are_free(faces, replaced)) return;
    if (!within_limits(params_.limits, mesh_, replaced, faces)) return;
    mesh_.flip(h);
    for (const FaceId f : replaced) tree_.update(f);
    ++counts_.flips;
  }

  HalfEdgeMesh& mesh_;
  const Enclosed& enclosed_;
  const TightenParams& params_;
  TightenCounts& counts_;
  FaceTree tree_;
  Guard guard_;
  std::vector<double> step_;  // per vertex, lattice units
  std::vector<NewFace> star_;
  std::vector<FaceId> replaced_;
  std::vector<Tetrahedron> swept_;
};

}  // namespace

LatticeMesh tighten(const LatticeMesh& proxy, const Enclosed& enclosed, const TightenParams& params,
                    TightenCounts& counts) {
  counts = {};
  if (proxy.triangles.empty()) return proxy;
  HalfEdgeMesh mesh(proxy);
  Tightener(mesh, enclosed, params, counts).run();
  LatticeMesh out = mesh.compact(proxy.frame);
  out.provenance = proxy.provenance;
  return out;
}

}  // namespace bp
