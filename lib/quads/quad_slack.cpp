// [TPC*10] repairs a pairing by flips and moves on the surface. Here both also must keep the enclosed set inside, under
// either diagonal.
#include "lib/quads/quad_slack.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "lib/core/vec3.h"
#include "lib/exact/predicates.h"
#include "lib/quads/detail/enclosed_by_pairs.h"
#include "lib/quads/quads.h"
#include "lib/tighten/fan_fit.h"
#include "lib/tighten/proxy_editor.h"
#include "lib/tighten/tight_proxy.h"

namespace bp {

namespace {

constexpr double kLift = 0.5;  // times the mean spoke: the farthest that a vertex is lifted
constexpr int kLiftRounds = 4;
constexpr int kRounds = 2;  // the second round finds some more pairs, at next to no volume

/// Joins pairs and gives each the diagonal that is nearer to the enclosed set.
class Lifter {
 public:
  Lifter(ProxyEditor& editor, EnclosedByPairs& kept) : editor_(editor), mesh_(editor.mesh()), kept_(kept) {}

  /// Joins two faces, and lifts a vertex where that makes the other diagonal safe.
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
    HalfEdgeId edge;  // the vertex is the corner opposite of this edge
    Vec3d offset;
    double volume;
  };

  /// Lifts one end of the other diagonal: the end that costs less volume.
  bool lift(HalfEdgeId h) {
    const std::optional<Lift> one = solve(h), other = solve(mesh_.twin(h));
    if (!one && !other) return false;
    const bool first = one && (!other || one->volume <= other->volume);
    if (raise(first ? *one : *other)) return true;
    return one && other && raise(first ? *other : *one);
  }

  std::optional<Lift> solve(HalfEdgeId h) {
    const double reach = kLift * gather(h);
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
    const double reach = kLift * gather(h);
    if (!fit_.close()) return false;
    for (int round = 0; round < kLiftRounds; ++round) {
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

  /// Gathers the fan around the corner opposite of h, as if h were flipped; returns the mean length of its spokes.
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

/// Joins pairs, then moves vertices back in as far as the pairs allow.
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
