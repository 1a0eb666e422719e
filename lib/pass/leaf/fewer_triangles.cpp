#include "lib/pass/leaf/fewer_triangles.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>
#include <tuple>

#include "lib/mesh/quadric.h"
#include "lib/pass/leaf/detail/leaf_edge.h"
#include "lib/pass/leaf/detail/leaf_mesh.h"
#include "lib/pass/leaf/detail/leaf_quadrics.h"
#include "lib/pass/leaf/detail/tile_parts.h"

namespace bp {

namespace {

using Index = LeafMesh::Index;

/// Where costs are equal, as in a plane, a short edge collapses first: this times its length counts as a distance.
constexpr double kShort = 1e-3;
/// A new place costs less than this share of the better end's. Between the ends thin tubes would shrink.
constexpr double kWorthMoving = 0.5;

/// An edge in the order of collapses.
struct Entry {
  double cost = 0;
  Index u = 0, v = 0;
  std::uint32_t stamp_u = 0, stamp_v = 0;  ///< of the ends when it was rated
  friend bool operator>(const Entry& a, const Entry& b) {
    return std::tie(a.cost, a.u, a.v) > std::tie(b.cost, b.u, b.v);
  }
};

/// A place for the point that an edge collapses into: from its first end, with the share of the way to the other one.
struct Place {
  double cost = 0;
  Vec3d to{};
  double share = 0;
};

/// Returns whether a seam forbids the place. Between two seams is a strip, such as the rim of a board: it may vanish
/// into either of them, which the planes of the seams rate by its width.
bool is_held(const EdgeCorners& corners, const Place& place, const Vec3d& edge) {
  if (!corners.holds_u && !corners.holds_v) return false;
  if (place.to != (place.share > 0 ? edge : Vec3d{})) return true;
  return corners.holds_u != corners.holds_v && (corners.holds_u ? place.share > 0 : place.share < 1);
}

class EdgeCollapses {
 public:
  /// `tile`: the box of a tile; null: the leaf is the whole scene.
  EdgeCollapses(const SceneLeaf& leaf, LeafFolds folds, const Bounds3d* tile = nullptr)
      : whole_(leaf),
        mesh_(leaf),
        quadrics_(quadrics_of(mesh_, folds == LeafFolds::held)),
        stamps_(mesh_.point_count(), 0) {
    if (tile != nullptr) parts_.emplace(mesh_, leaf, *tile);
  }

  SceneLeaf run(std::uint64_t triangles) {
    while (mesh_.face_count() > triangles) {
      if (order_.empty() && mesh_.face_count() != rated_faces_) {
        rated_faces_ = mesh_.face_count();
        rate_all();  // edges that were not possible may be now
      }
      if (drops_part()) continue;
      if (order_.empty()) break;
      take_next();
    }
    return mesh_.leaf(whole_);
  }

  /// Returns what run() left of a tile.
  FewerTriangles run_tile(std::uint64_t triangles) {
    SceneLeaf leaf = run(triangles);
    return {std::move(leaf), parts_->triangles_of(whole_, mesh_, true), parts_->triangles_of(whole_, mesh_, false)};
  }

 private:
  /// Drops the cheapest part of a tile if nothing that costs less is left to do. The last part of all stays.
  bool drops_part() {
    const double cost = parts_ ? parts_->least_cost() : HUGE_VAL;
    if (cost == HUGE_VAL || (!order_.empty() && order_.top().cost < cost)) return false;
    const std::vector<Index> faces = parts_->take_cheapest(mesh_);
    if (faces.size() == mesh_.face_count()) return false;
    for (const Index f : faces) {
      for (std::size_t k = 0; k < 3; ++k) ++stamps_[mesh_.point_of(f, k)];
      mesh_.erase(f);
    }
    return true;
  }
  [[nodiscard]] bool stays(Index p) const { return parts_ && parts_->stays(p); }
  /// Returns whether a collapse would take all faces from a point that stays.
  [[nodiscard]] bool bares_point(Index u, Index v) const {
    if (!parts_) return false;
    const auto has_others = [&](Index p) {
      const auto& faces = mesh_.faces_of(p);
      return std::any_of(faces.begin(), faces.end(),
                         [&](Index f) { return mesh_.place_in(f, u) == 3 || mesh_.place_in(f, v) == 3; });
    };
    if ((stays(u) || stays(v)) && !has_others(u) && !has_others(v)) return true;
    const std::vector<Index> thirds = thirds_of(mesh_, u, v);
    return std::any_of(thirds.begin(), thirds.end(), [&](Index p) { return stays(p) && !has_others(p); });
  }

  void rate_all() {
    order_ = {};
    for (Index u = 0; u < mesh_.point_count(); ++u) rate_edges_of(u, true);
  }
  void rate_edges_of(Index u, bool once) {
    Index last = u;
    for (const Index v : mesh_.neighbours(u)) {
      if (v == last || (once && v < u)) continue;
      last = v;
      if (stays(u) && stays(v)) continue;
      const Index a = std::min(u, v), b = std::max(u, v);
      order_.push({places(a, b).front().cost, a, b, stamps_[a], stamps_[b]});
    }
  }

  /// Returns places for the point of an edge, the cheapest first.
  [[nodiscard]] std::vector<Place> places(Index u, Index v) const {
    const Vec3d d = mesh_.at(v) - mesh_.at(u);
    Quadric q = quadrics_[v].about(mesh_.at(u) - mesh_.at(v));
    q.add(quadrics_[u]);
    const double squared = dot(d, d), extra = kShort * kShort * squared * q.weight;
    const Vec3d best = minimum(q, 0.5 * d);
    const double share = squared > 0 ? std::clamp(dot(best, d) / squared, 0.0, 1.0) : 0;
    const auto rated = [&](const Vec3d& to, double part) {
      return Place{std::max(q.value(to), 0.0) + extra, to, part};
    };
    if (stays(u)) return {rated({}, 0)};
    if (stays(v)) return {rated(d, 1)};
    std::vector<Place> all{rated({}, 0), rated(d, 1)};
    if (all[1].cost < all[0].cost) std::swap(all[0], all[1]);
    if (const Place between = rated(best, share); between.cost < kWorthMoving * all[0].cost)
      all.insert(all.begin(), between);
    return all;
  }

  void take_next() {
    const Entry e = order_.top();
    order_.pop();
    if (e.stamp_u != stamps_[e.u] || e.stamp_v != stamps_[e.v]) return;
    if (!keeps_parts(mesh_, e.u, e.v) || bares_point(e.u, e.v)) return;
    const EdgeCorners corners = corners_of_edge(mesh_, e.u, e.v);
    for (const Place& place : places(e.u, e.v)) {
      if (is_held(corners, place, mesh_.at(e.v) - mesh_.at(e.u))) continue;
      const std::vector<LeafMesh::Change> changes = changes_of(mesh_, corners, place.share);
      if (turns_faces(mesh_, whole_, e.u, e.v, mesh_.at(e.u) + place.to, changes)) continue;
      if (place.cost > e.cost && !order_.empty() && place.cost > order_.top().cost)
        return order_.push({place.cost, e.u, e.v, e.stamp_u, e.stamp_v});
      return collapse(e.u, e.v, place, changes);
    }
  }

  void collapse(Index u, Index v, const Place& place, const std::vector<LeafMesh::Change>& changes) {
    Quadric q = quadrics_[v].about(mesh_.at(u) - mesh_.at(v));
    q.add(quadrics_[u]);
    quadrics_[u] = q.about(place.to);
    mesh_.collapse(u, v, mesh_.at(u) + place.to, changes);
    if (stays(v)) parts_->let_stay(u);
    ++stamps_[u];
    ++stamps_[v];
    rate_edges_of(u, false);
  }

  const SceneLeaf& whole_;
  LeafMesh mesh_;
  std::vector<Quadric> quadrics_;  // by point, relative to it
  std::vector<std::uint32_t> stamps_;
  std::optional<TileParts> parts_;  // none: the leaf is the whole scene
  std::size_t rated_faces_ = 0;     // when all edges were rated the last time
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> order_;
};

}  // namespace

std::vector<SceneLeaf> with_fewer_triangles(const SceneLeaf& leaf, std::span<const std::uint64_t> most,
                                            LeafFolds folds) {
  std::vector<SceneLeaf> all;
  std::optional<EdgeCollapses> collapses;
  for (const std::uint64_t triangles : most) {
    if (leaf.triangles() <= triangles) {
      all.push_back(leaf);
      continue;
    }
    if (!collapses) collapses.emplace(leaf, folds);
    all.push_back(collapses->run(triangles));
  }
  return all;
}

FewerTriangles tile_with_fewer_triangles(const SceneLeaf& tile, const Bounds3d& box, std::uint64_t most,
                                         LeafFolds folds) {
  return EdgeCollapses(tile, folds, &box).run_tile(most);
}

}  // namespace bp
