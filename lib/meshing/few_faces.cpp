#include "lib/meshing/few_faces.h"

#include <algorithm>
#include <optional>

#include "lib/meshing/convex_budget.h"
#include "lib/meshing/convex_parts.h"

namespace bp {

namespace {

constexpr double kHopeless = 1.5;  // times the least volume so far: fewer faces will not come below it

/// A proxy on the way, and what led to it.
struct Stop {
  LatticeMesh mesh;
  SimplifyCounts simplified;
  TightenCounts tightened;
};

class Way {
 public:
  Way(const SurfaceSource& dense, const Enclosed& enclosed, const SimplifyParams& params)
      : enclosed_(enclosed), params_(params), box_(dense.box()) {
    at_.mesh = tight_proxy(dense, enclosed, params_for(kFewFaces), at_.simplified, at_.tightened);
    params_.dense = false;
    if (!is_there() || components_of(at_.mesh).size() > 1) return;
    if (std::optional<ConvexHull> hull = hull_of(at_.mesh.vertices)) hull_.push_back(std::move(*hull));
  }

  [[nodiscard]] const Stop& at() const { return at_; }
  [[nodiscard]] std::uint64_t faces() const { return at_.mesh.triangles.size(); }
  /// The first proxy has few faces.
  [[nodiscard]] bool is_there() const { return faces() > 0 && faces() <= kFewFaces; }

  /// On to at most `n` faces; false if there is no way.
  bool go(std::uint64_t n) {
    Stop next = at_;
    next.mesh = tight_proxy(at_.mesh, enclosed_, params_for(n), next.simplified, next.tightened);
    std::optional<Stop> convex = convex_stop(n);
    const bool reached = next.mesh.triangles.size() <= n;
    if (!reached && !convex) return false;
    at_ =
        convex && (!reached || volume6_of(convex->mesh) < volume6_of(next.mesh)) ? std::move(*convex) : std::move(next);
    return true;
  }

 private:
  [[nodiscard]] SimplifyParams params_for(std::uint64_t n) const {
    SimplifyParams params = params_;
    params.faces = n;
    params.room = room_around(box_, n);
    return params;
  }

  /// A hull of at most n faces around the hull of the first proxy, tightened.
  [[nodiscard]] std::optional<Stop> convex_stop(std::uint64_t n) {
    if (hull_.empty()) return {};
    keep_to_faces(hull_, n);
    if (face_count(hull_) > n) return {};
    Stop stop;
    stop.mesh.frame = at_.mesh.frame;
    stop.mesh.provenance = at_.mesh.provenance;
    stop.mesh.vertices = hull_[0].vertices;
    stop.mesh.triangles = hull_[0].triangles;
    stop.simplified = at_.simplified;
    stop.mesh = tight_proxy(stop.mesh, enclosed_, params_for(n), stop.simplified, stop.tightened);
    return stop;
  }

  const Enclosed& enclosed_;
  SimplifyParams params_;
  LatticeBox box_;
  std::vector<ConvexHull> hull_;  // one, if the scene is in one piece
  Stop at_;
};

}  // namespace

LatticeMesh tight_proxy_of_few(const SurfaceSource& dense, const Enclosed& enclosed, const SimplifyParams& params,
                               SimplifyCounts& simplified, TightenCounts& tightened) {
  Way way(dense, enclosed, params);
  std::optional<Stop> best;
  for (std::uint64_t n = way.faces(); way.is_there();) {
    if (n <= params.faces && (!best || volume6_of(way.at().mesh) < volume6_of(best->mesh))) best = way.at();
    if (best && double(volume6_of(way.at().mesh)) > kHopeless * double(volume6_of(best->mesh))) break;
    if (n <= 4 || !way.go((n - 1) / 2 * 2)) break;
    n = way.faces();
    if (getenv("FEWDBG")) fprintf(stderr, "%llu %.5g\n", (unsigned long long)n, double(volume6_of(way.at().mesh)));
  }
  if (!best) return tight_proxy(dense, enclosed, params, simplified, tightened);
  simplified = best->simplified;
  simplified.faces_out = best->mesh.triangles.size();
  simplified.stop = StopReason::faces;
  tightened = best->tightened;
  return std::move(best->mesh);
}

}  // namespace bp
