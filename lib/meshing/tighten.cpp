// Sweeps over all vertices, then all edges. Where something that must stay inside blocks a vertex's best place, the fit
// learns of it and is solved again (cutting planes with the exact test as the oracle).
#include "lib/meshing/tighten.h"

#include <cmath>

#include "lib/core/predicates.h"
#include "lib/core/vec3.h"
#include "lib/meshing/fan_fit.h"
#include "lib/meshing/shells.h"

namespace bp {

namespace {

constexpr double kReach = 0.5;  // of the mean spoke: how far a vertex may move at once
constexpr double kWeightFall = 0.7;
constexpr int kAvoidRounds = 4;
constexpr int kSweepsPerRefresh = 8;

double volume_of(const HalfEdgeMesh& mesh) {
  return double(mesh.volume6()) / 6;
}

class Tightener {
 public:
  Tightener(ProxyEditor& editor, const TightenParams& params, TightenCounts& counts)
      : editor_(editor), mesh_(editor.mesh()), params_(params), counts_(counts) {}

  void run() {
    const double volume = volume_of(mesh_), least_gain = params_.least_gain * std::abs(volume);
    weight_ = params_.first_weight * std::abs(volume) / double(editor_.contacts().size() + 1);
    double last = volume;
    for (int i = 0; i < params_.sweeps; ++i) {
      const double now = sweep();
      weight_ *= kWeightFall;
      if (i > 0 && last - now < least_gain) break;
      last = now;
    }
    weight_ = 0;
    for (int i = 0; i < params_.final_sweeps; ++i) {
      const double now = sweep();
      if (last - now < least_gain) break;
      last = now;
    }
  }

 private:
  double sweep() {
    for (VertexId v = 0; v < mesh_.vertex_capacity(); ++v) {
      if (mesh_.vertex_alive(v)) move_vertex(v);
    }
    for (HalfEdgeId h = 0; h < 3 * mesh_.face_capacity(); ++h) {
      if (mesh_.alive(HalfEdgeMesh::face(h)) && mesh_.edge(h) == h && is_convex(h)) counts_.flips += editor_.flip(h);
    }
    if (++counts_.sweeps % kSweepsPerRefresh == 0) editor_.refresh();
    return volume_of(mesh_);
  }

  /// Flipping a convex edge cuts a tetrahedron off the solid.
  [[nodiscard]] bool is_convex(HalfEdgeId h) const {
    return orient3d(mesh_.position(mesh_.from(h)), mesh_.position(mesh_.to(h)), mesh_.position(mesh_.opposite(h)),
                    mesh_.position(mesh_.opposite(mesh_.twin(h)))) < 0;
  }

  void move_vertex(VertexId v) {
    const double reach = kReach * gather(v);
    if (!fit_.close()) return;
    const Vec3d shift = to_double(mesh_.position(v) - editor_.contacts().origin());
    for (int round = 0;; ++round) {
      const std::optional<Vec3d> x =
          weight_ > 0 ? std::optional(fit_.balanced({}, weight_, reach)) : fit_.least_volume({}, reach);
      if (!x || !worth_trying(*x) || try_move(v, *x)) return;
      if (round < kAvoidRounds && editor_.blocker() != nullptr && fit_.avoid(*x, *editor_.blocker(), shift)) {
        editor_.learn(v, fit_.obstacles());
        continue;
      }
      shorten(v, *x, reach);
      return;
    }
  }

  /// Less of the way; and where limits may mind a step aside, straight inwards.
  void shorten(VertexId v, const Vec3d& x, double reach) {
    for (double share = 0.5; share > 0.1 && worth_trying(share * x); share /= 2) {
      if (try_move(v, share * x)) return;
    }
    if (params_.limits == nullptr) return;
    const Vec3d inwards = -reach * fit_.outward();
    for (double share = 0.5; share > 0.01 && worth_trying(share * inwards); share /= 2) {
      if (try_move(v, share * inwards)) return;
    }
  }

  [[nodiscard]] bool worth_trying(const Vec3d& x) const {
    const LatticeCoord d = rounded(x);
    return d != LatticeCoord{} && (weight_ > 0 || fit_.volume(to_double(d)) < 0);
  }
  bool try_move(VertexId v, const Vec3d& x) {
    const bool taken = editor_.move(v, mesh_.position(v) + rounded(x));
    counts_.moves += taken;
    return taken;
  }

  /// The star as a fan about the vertex; its mean spoke.
  double gather(VertexId v) {
    const ContactPoints& contacts = editor_.contacts();
    const LatticeCoord p = mesh_.position(v);
    const Vec3d shift = to_double(p - contacts.origin());
    fit_.clear();
    double edges = 0;
    std::uint32_t sector = 0;
    mesh_.for_each_outgoing(v, [&](HalfEdgeId h) {
      const Vec3d a = to_double(mesh_.position(mesh_.to(h)) - p);
      fit_.add_rim(a);
      edges += length(a);
      for (const std::uint32_t i : contacts.of(HalfEdgeMesh::face(h))) fit_.add_point(contacts[i] - shift, sector);
      ++sector;
    });
    return edges / sector;
  }

  ProxyEditor& editor_;
  const HalfEdgeMesh& mesh_;
  const TightenParams& params_;
  TightenCounts& counts_;
  FanFit fit_;
  double weight_ = 0;  // of the barrier, volume per point; 0: none
};

}  // namespace

LatticeMesh tighten(ProxyEditor& editor, const GridFrame& frame, const TightenParams& params, TightenCounts& counts) {
  counts = {};
  const std::uint64_t tries = editor.counts().tries;
  HalfEdgeMesh before = editor.mesh();
  erase_inner_shells(before, editor.inwards());  // those of collapses with the same editor
  counts.volume_before = volume_of(before);
  Tightener(editor, params, counts).run();
  editor.erase_inner_shells();
  counts.volume_after = volume_of(editor.mesh());
  counts.tries = editor.counts().tries - tries;
  if (counts.volume_after <= counts.volume_before) return editor.mesh().compact(frame);
  counts.volume_after = counts.volume_before;
  return before.compact(frame);
}

LatticeMesh tighten(const LatticeMesh& proxy, const Enclosed& enclosed, const TightenParams& params,
                    TightenCounts& counts) {
  counts = {};
  if (proxy.triangles.empty()) return proxy;
  HalfEdgeMesh mesh(proxy);
  ProxyEditor editor(mesh, enclosed, params.edge_limit, params.limits);
  LatticeMesh out = tighten(editor, proxy.frame, params, counts);
  out.provenance = proxy.provenance;
  return out;
}

}  // namespace bp
