// [TPC*10] repairs a pairing by flips and moves on the surface; here both are bound to keep something inside, under
// either diagonal.
#include "lib/quads/quad_slack.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "lib/core/vec3.h"
#include "lib/exact/predicates.h"
#include "lib/quads/quads.h"
#include "lib/tighten/fan_fit.h"
#include "lib/tighten/proxy_editor.h"
#include "lib/tighten/tight_proxy.h"

namespace bp {

namespace {

constexpr double kReach = 0.5;  // of the mean spoke: how far a vertex is lifted at most
constexpr int kAvoidRounds = 4;
constexpr int kRounds = 2;  // the second finds some pairs more on the way back in, and costs next to no volume

/// What must stay inside under either diagonal of each pair.
class EnclosedByPairs final : public Enclosed {
 public:
  EnclosedByPairs(const HalfEdgeMesh& mesh, const Enclosed& enclosed)
      : mesh_(mesh), enclosed_(enclosed), partner_(mesh.face_capacity(), kNoId) {}

  void join(FaceId f, FaceId g) {
    partner_[f] = g;
    partner_[g] = f;
  }
  /// Flips are refused but while this is set: they would break pairs.
  void allow_flips(bool on) { flips_ = on; }

  [[nodiscard]] bool allows(std::span<const NewFace> star, std::span<const Tetrahedron> swept,
                            Blocker* blocker) const override {
    const bool flip = star[0].ids[0] != star[1].ids[0];
    if (flip) return flips_ && enclosed_.allows(star, swept, blocker);
    return enclosed_.allows(star, swept, blocker) && across_allows(star[0].ids[0], star[0].corners[0], blocker);
  }
  [[nodiscard]] std::vector<Vec3d> contact_points(const LatticeCoord& origin, const LatticeBox& within) const override {
    return enclosed_.contact_points(origin, within);
  }
  [[nodiscard]] std::uint64_t bytes() const override { return enclosed_.bytes(); }

 private:
  /// The pairs around v, drawn the other way.
  [[nodiscard]] bool across_allows(VertexId v, const LatticeCoord& to, Blocker* blocker) const {
    std::vector<NewFace> faces;
    std::vector<Tetrahedron> swept;
    bool fine = true;
    const LatticeCoord p = mesh_.position(v);
    const auto add = [&](VertexId a, VertexId b) {
      const LatticeCoord &pa = mesh_.position(a), &pb = mesh_.position(b);
      faces.push_back({{v, a, b}, {to, pa, pb}});
      if (orient3d(p, pa, pb, to) < 0) swept.push_back({p, pa, pb, to});
    };
    mesh_.for_each_outgoing(v, [&](HalfEdgeId h) {
      const FaceId partner = partner_[HalfEdgeMesh::face(h)];
      if (partner == kNoId) return;
      std::array<VertexId, 4> quad;  // from v on
      const HalfEdgeId beyond = mesh_.twin(HalfEdgeMesh::next(h));
      if (HalfEdgeMesh::face(mesh_.twin(h)) == partner) {  // the diagonal ends here: once for both faces
        quad = {v, mesh_.opposite(mesh_.twin(h)), mesh_.to(h), mesh_.opposite(h)};
        add(quad[1], quad[3]);
      } else if (HalfEdgeMesh::face(beyond) == partner) {
        quad = {v, mesh_.to(h), mesh_.opposite(beyond), mesh_.opposite(h)};
        add(quad[1], quad[2]);
        add(quad[2], quad[3]);
      } else {
        return;
      }
      fine = fine && keeps_shape(quad, to);
    });
    return fine && (faces.empty() || enclosed_.allows(faces, swept, blocker));
  }

  [[nodiscard]] bool keeps_shape(const std::array<VertexId, 4>& quad, const LatticeCoord& to) const {
    std::array<LatticeCoord, 4> p;
    for (std::size_t i = 0; i < 4; ++i) p[i] = mesh_.position(quad[i]);
    const double before = quad_quality(p);
    p[0] = to;
    return quad_quality(p) >= std::min(before, kLeastQuadQuality);
  }

  const HalfEdgeMesh& mesh_;
  const Enclosed& enclosed_;
  std::vector<FaceId> partner_;
  bool flips_ = false;
};

/// Draws pairs over the diagonal nearer to what is enclosed.
class Lifter {
 public:
  Lifter(ProxyEditor& editor, EnclosedByPairs& kept) : editor_(editor), mesh_(editor.mesh()), kept_(kept) {}

  /// Makes either diagonal safe, if that can be.
  void join(FaceId f, FaceId g) {
    HalfEdgeId h = 3 * f;
    while (HalfEdgeMesh::face(mesh_.twin(h)) != g) ++h;
    if (!editor_.is_convex(h) || flip(h) || lift(h)) kept_.join(f, g);
  }

 private:
  bool flip(HalfEdgeId h) {
    kept_.allow_flips(true);
    const bool flipped = editor_.flip(h);
    kept_.allow_flips(false);
    return flipped;
  }

  struct Lift {
    HalfEdgeId edge;  // the vertex is its opposite corner
    Vec3d offset;
    double volume;
  };

  /// Lifts one end of the other diagonal, the cheaper one.
  bool lift(HalfEdgeId h) {
    const std::optional<Lift> one = solve(h), other = solve(mesh_.twin(h));
    if (!one && !other) return false;
    const bool first = one && (!other || one->volume <= other->volume);
    if (raise(first ? *one : *other)) return true;
    return one && other && raise(first ? *other : *one);
  }

  std::optional<Lift> solve(HalfEdgeId h) {
    const double reach = kReach * gather(h);
    if (!fit_.close()) return std::nullopt;
    const auto x = fit_.least_volume({}, reach);
    if (!x) return std::nullopt;
    return Lift{h, *x, fit_.volume(*x)};
  }

  bool raise(Lift lift) {
    const HalfEdgeId h = lift.edge;
    const VertexId v = mesh_.opposite(h);
    const LatticeCoord p = mesh_.position(v);
    const Vec3d shift = to_double(p - editor_.contacts().origin());
    const double reach = kReach * gather(h);
    if (!fit_.close()) return false;
    for (int round = 0; round < kAvoidRounds; ++round) {
      const LatticeCoord to = p + rounded(lift.offset);
      const bool moved = to == p || editor_.move(v, to);
      if (moved && flip(h)) return true;
      const bool blocked = editor_.blocker() != nullptr;
      const Blocker blocker = blocked ? *editor_.blocker() : Blocker{};
      if (moved && to != p && !editor_.move(v, p)) return false;
      if (!blocked || !fit_.avoid(lift.offset, blocker, shift)) return false;
      const auto x = fit_.least_volume({}, reach);
      if (!x) return false;
      lift.offset = *x;
    }
    return false;
  }

  /// The fan around the corner opposite of h, as if h were flipped; its mean spoke.
  double gather(HalfEdgeId h) {
    const VertexId v = mesh_.opposite(h);
    const LatticeCoord p = mesh_.position(v);
    fit_.clear();
    double edges = 0;
    std::uint32_t sector = 0;
    const auto add = [&](VertexId r) {
      const Vec3d a = to_double(mesh_.position(r) - p);
      fit_.add_rim(a);
      edges += length(a);
    };
    mesh_.for_each_outgoing(v, [&](HalfEdgeId g) {
      add(mesh_.to(g));
      add_points(HalfEdgeMesh::face(g), p, sector++);
      if (HalfEdgeMesh::next(g) != h) return;
      add_points(HalfEdgeMesh::face(mesh_.twin(h)), p, sector);
      add(mesh_.opposite(mesh_.twin(h)));
      ++sector;
    });
    return edges / sector;
  }

  void add_points(FaceId f, const LatticeCoord& origin, std::uint32_t sector) {
    const Vec3d shift = to_double(origin - editor_.contacts().origin());
    for (const std::uint32_t i : editor_.contacts().of(f)) fit_.add_point(editor_.contacts()[i] - shift, sector);
  }

  ProxyEditor& editor_;
  const HalfEdgeMesh& mesh_;
  EnclosedByPairs& kept_;
  FanFit fit_;
};

/// Pairs are joined; what they grew by is taken back.
LatticeMesh one_round(const LatticeMesh& mesh, const Enclosed& enclosed, const SimplifyParams& params) {
  HalfEdgeMesh edited(mesh);
  EnclosedByPairs kept(edited, enclosed);
  ProxyEditor editor(edited, kept, params);
  Lifter lifter(editor, kept);
  for (const auto& pair : pair_triangles(mesh, QuadKeeps::slack, &enclosed)) lifter.join(pair[0], pair[1]);
  TightenCounts counts;
  return tighten(editor, mesh.frame, tightening_of(params), counts);
}

}  // namespace

LatticeMesh make_room_for_quads(const LatticeMesh& mesh, const Enclosed& enclosed, const SimplifyParams& params) {
  if (mesh.triangles.empty()) return mesh;
  LatticeMesh out = mesh;
  for (int round = 0; round < kRounds; ++round) out = one_round(out, enclosed, params);
  out.provenance = mesh.provenance;
  return out;
}

}  // namespace bp
