#include "lib/tighten/few_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "lib/enclosed/few_contacts.h"
#include "lib/hulls/convex_budget.h"
#include "lib/hulls/convex_parts.h"

namespace bp {

namespace {

constexpr double kHopeless = 1.25;  // times the least volume so far: proxies of fewer faces will not hold less
constexpr double kPromising = 1.5;  // the same for a hull that is not tightened yet
/// Numbers of faces for which a proxy is also made anew from the first surface. This also happens when the sequence is
/// stuck.
constexpr std::array<std::uint64_t, 6> kFresh{48, 32, 24, 20, 8, 6};

/// Returns the next number of faces in the sequence; fewer(n + 1) is the first one up to n.
std::uint64_t fewer(std::uint64_t n) {
  return n > 40 ? (n - 1) / 4 * 4 : (n - 1) / 2 * 2;
}

/// Returns whether a proxy holds clearly more than another one; of proxies inside, whether it holds clearly less.
bool is_hopeless(const TightProxy& proxy, const TightProxy& best) {
  const double now6 = double(volume6_of(proxy.mesh)), best6 = double(volume6_of(best.mesh));
  return best6 > 0 ? now6 > kHopeless * best6 : now6 > best6 / kHopeless;
}

class HullsWay {
 public:
  HullsWay(const SurfaceSource& dense, const Enclosed& enclosed, const SimplifyParams& params)
      : dense_(dense), enclosed_(enclosed), params_(params), box_(dense.box()) {
    SimplifyParams growing = growing_part_of(params_for(kFewFaces));
    growing.room = room_around(box_, growing.faces);
    grown_.mesh = simplify(dense, growing, grown_.simplified);
    if (grown_.mesh.triangles.empty()) return;
    outer_.emplace(enclosed, HalfEdgeMesh(grown_.mesh));
    params_.dense = false;
    at_ = tight(grown_, kFewFaces);
    if (!is_there() || volume6_of(at_.mesh) < 0 || components_of(at_.mesh).size() > 1) return;
    if (std::optional<ConvexHull> hull = hull_of(at_.mesh.vertices)) hull_.push_back(std::move(*hull));
  }

  [[nodiscard]] const TightProxy& at() const { return at_; }
  [[nodiscard]] std::uint64_t faces() const { return at_.mesh.triangles.size(); }
  /// Returns whether the first proxy has few faces.
  [[nodiscard]] bool is_there() const { return faces() > 0 && faces() <= kFewFaces; }

  /// Goes on to the next number of faces that a proxy can be made for, and that parts and handles allow. Returns false
  /// at the end.
  bool go() {
    const std::uint64_t least = least_faces();
    for (std::uint64_t n = fewer(faces()); n >= least; n = fewer(n))
      if (go(n)) return true;
    return false;
  }

 private:
  /// Goes on to at most `n` faces. Returns false if no proxy has so few.
  bool go(std::uint64_t n) {
    std::optional<TightProxy> best;
    const auto offer = [&](TightProxy stop) {
      if (stop.mesh.triangles.size() > n) return;
      if (!best || volume6_of(stop.mesh) < volume6_of(best->mesh)) best = std::move(stop);
    };
    offer(tight(at_, n));
    const bool stuck = !best;
    if (stuck || std::find(kFresh.begin(), kFresh.end(), n) != kFresh.end()) offer(tight(grown_, n));
    if (stuck) offer(from_dense(n));
    if (std::optional<TightProxy> hull = convex(n)) {
      const double now6 = best ? double(volume6_of(best->mesh)) : HUGE_VAL;
      if (double(volume6_of(hull->mesh)) < kPromising * now6) offer(tight(*hull, n));
    }
    if (best) at_ = std::move(*best);
    return best.has_value();
  }

  /// Returns four faces for each part and each handle: no closed surface has fewer.
  [[nodiscard]] std::uint64_t least_faces() const {
    const std::size_t parts = components_of(at_.mesh).size();
    const std::size_t handles = (4 * parts + faces() - 2 * at_.mesh.vertices.size()) / 4;  // by Euler's formula
    return 4 * (parts + handles);
  }

  [[nodiscard]] SimplifyParams params_for(std::uint64_t n) const {
    SimplifyParams params = params_;
    params.faces = n;
    params.room = room_around(box_, n);
    return params;
  }

  /// Returns a proxy of n faces that is made from another one with more.
  [[nodiscard]] TightProxy tight(const TightProxy& from, std::uint64_t n) const {
    return tight_proxy(from.mesh, *outer_, params_for(n));
  }

  [[nodiscard]] TightProxy from_dense(std::uint64_t n) const {
    SimplifyParams params = params_for(n);
    params.dense = true;
    return tight_proxy(dense_, enclosed_, params);
  }

  /// Returns a hull of at most n faces around the hull of the first proxy. Returns nothing for more than half of
  /// kFewFaces: another proxy is better than a convex one then.
  [[nodiscard]] std::optional<TightProxy> convex(std::uint64_t n) {
    if (hull_.empty() || n > kFewFaces / 2) return {};
    keep_to_faces(hull_, n, kFarOut);
    TightProxy stop = at_;
    stop.mesh.vertices = hull_[0].vertices;
    stop.mesh.triangles = hull_[0].triangles;
    return stop;
  }

  const SurfaceSource& dense_;
  const Enclosed& enclosed_;
  std::optional<FewContacts> outer_;  // the enclosed contacts of grown_, for everything that is made from it
  SimplifyParams params_;
  LatticeBox box_;
  std::vector<ConvexHull> hull_;  // one hull, if the scene is in one piece; else empty
  TightProxy at_, grown_;
};

}  // namespace

TightProxy tight_proxy_of_few(const SurfaceSource& dense, const Enclosed& enclosed, const SimplifyParams& params) {
  HullsWay way(dense, enclosed, params);
  const std::uint64_t first = way.faces();
  std::optional<TightProxy> best;
  const auto offer = [&](const TightProxy& stop) {
    if (stop.mesh.triangles.size() > params.faces) return;
    if (!best || volume6_of(stop.mesh) < volume6_of(best->mesh)) best = stop;
  };
  while (way.is_there()) {
    offer(way.at());
    if (best && is_hopeless(way.at(), *best)) break;
    if (!way.go()) break;
  }
  if (!best) {  // parts and handles need more faces
    TightProxy proxy = tight_proxy(dense, enclosed, params);
    const std::uint64_t faces = proxy.mesh.triangles.size();
    if (faces <= params.faces || !way.is_there() || way.faces() > faces) return proxy;
    if (way.faces() == faces && volume6_of(way.at().mesh) >= volume6_of(proxy.mesh)) return proxy;
    best = way.at();
    best->simplified.refused = proxy.simplified.refused;
    best->simplified.stop = proxy.simplified.stop;
  }
  SimplifyCounts& simplified = best->simplified;
  simplified.faces_out = best->mesh.triangles.size();
  const std::uint64_t tried = std::min(params.faces, first);
  const bool least = simplified.faces_out < fewer(tried + 1);
  if (simplified.faces_out <= params.faces) simplified.stop = least ? StopReason::least_volume : StopReason::faces;
  return std::move(*best);
}

}  // namespace bp
