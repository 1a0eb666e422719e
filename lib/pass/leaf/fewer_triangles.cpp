#include "lib/pass/leaf/fewer_triangles.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>
#include <tuple>

#include "lib/mesh/quadric.h"
#include "lib/pass/leaf/detail/leaf_mesh.h"
#include "lib/pass/leaf/detail/tile_parts.h"

namespace bp {

namespace {

using Index = LeafMesh::Index;
using Look = LeafMesh::Look;
using Change = LeafMesh::Change;

/// Where costs are equal, as in a plane, a short edge collapses first: this times its length counts as a distance.
constexpr double kShort = 1e-3;
/// A new place costs less than this share of the better end's. Between the ends thin tubes would shrink.
constexpr double kWorthMoving = 0.5;
constexpr double kSharpCosine = 0.1;  // between faces at a fold that may be held: about a right angle
/// A face turns by less than 78 degrees in one collapse.
constexpr double kLeastCosine = 0.2;

Look between(const Look& a, const Look& b, double t) {
  if (t == 0 || t == 1) return t == 0 ? a : b;  // points that stay keep their looks to the last bit
  const auto mix = [t](double x, double y) { return x + t * (y - x); };
  Look out = a;
  double length = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    out.normal[i] = float(mix(a.normal[i], b.normal[i]));
    length += double(out.normal[i]) * out.normal[i];
  }
  for (float& x : out.normal)
    x = length > 1e-6 ? float(x / std::sqrt(length)) : a.normal[std::size_t(&x - &out.normal[0])];
  for (std::size_t i = 0; i < 2; ++i) {
    out.uv[i] = float(mix(a.uv[i], b.uv[i]));
    out.second_uv[i] = float(mix(a.second_uv[i], b.second_uv[i]));
  }
  const auto mixed = [&](std::uint16_t x, std::uint16_t y) { return std::uint16_t(mix(x, y) + 0.5); };
  out.color = {mixed(a.color.r, b.color.r), mixed(a.color.g, b.color.g), mixed(a.color.b, b.color.b)};
  return out;
}

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

/// Twice the area of a triangle of texture coordinates, with its sign.
double turn_of(const std::array<float, 2>& a, const std::array<float, 2>& b, const std::array<float, 2>& c) {
  return (double(b[0]) - a[0]) * (double(c[1]) - a[1]) - (double(c[0]) - a[0]) * (double(b[1]) - a[1]);
}

class EdgeCollapses {
 public:
  /// `tile`: the box of a tile; null: the leaf is the whole scene.
  EdgeCollapses(const SceneLeaf& leaf, LeafFolds folds, const Bounds3d* tile = nullptr)
      : whole_(leaf), folds_(folds), mesh_(leaf), quadrics_(mesh_.point_count()), stamps_(mesh_.point_count(), 0) {
    for (Index p = 0; p < mesh_.point_count(); ++p) {
      for (const Index f : mesh_.faces_of(p)) add_planes(p, f);
    }
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
  /// The corners at both ends of an edge: pairs that a face has, and others.
  struct Corners {
    std::vector<std::pair<Index, Index>> pairs;
    std::vector<Index> others_u, others_v;
    bool holds_u = false, holds_v = false;  ///< a seam goes on from the end elsewhere, so that this must not move
  };

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
    const std::vector<Index> thirds = thirds_of(u, v);
    return std::any_of(thirds.begin(), thirds.end(), [&](Index p) { return stays(p) && !has_others(p); });
  }

  // --- quadrics

  /// Adds the plane of a face around a point, and those that hold its borders and seams.
  void add_planes(Index p, Index f) {
    const std::size_t k = mesh_.place_in(f, p);
    const Index a = mesh_.point_of(f, (k + 1) % 3), b = mesh_.point_of(f, (k + 2) % 3);
    const Vec3d to_a = mesh_.at(a) - mesh_.at(p), to_b = mesh_.at(b) - mesh_.at(p);
    const Vec3d normal = cross(to_a, to_b);
    const double area2 = length(normal);
    if (!(area2 > 0)) return;
    const Vec3d n = (1 / area2) * normal;
    quadrics_[p].add_plane(n, 0, area2 / 2);
    hold_edge(p, a, f, to_a, n);
    hold_edge(p, b, f, to_b, n);
  }
  void hold_edge(Index p, Index other, Index f, const Vec3d& along, const Vec3d& n) {
    const double squared = dot(along, along);
    const double weight = weight_of_edge(p, other, f);
    if (weight > 0 && squared > 0) quadrics_[p].add_plane(unit(cross(along, n), n), 0, weight * squared);
  }
  /// Returns the weight of a plane through an edge of the face, which holds its course: 1 for a border and a seam, and
  /// a part of that for a fold that is held. A border is a fold by half a turn.
  [[nodiscard]] double weight_of_edge(Index p, Index other, Index f) const {
    const Look& own = mesh_.corner(mesh_.face(f)[mesh_.place_in(f, p)]).look;
    const Look& far = mesh_.corner(mesh_.face(f)[mesh_.place_in(f, other)]).look;
    double cosine = -1;
    bool is_border = true;
    // The end with fewer faces tells, since the other one may have thousands.
    const Index end = mesh_.faces_of(p).size() < mesh_.faces_of(other).size() ? p : other;
    for (const Index g : mesh_.faces_of(end)) {
      const std::size_t here = mesh_.place_in(g, p), there = mesh_.place_in(g, other);
      if (g == f || here == 3 || there == 3) continue;
      cosine = is_border ? dot(normal_of(f), normal_of(g)) : std::min(cosine, dot(normal_of(f), normal_of(g)));
      is_border = false;
      if (!mesh_.corner(mesh_.face(g)[here]).look.joins(own) || !mesh_.corner(mesh_.face(g)[there]).look.joins(far))
        return 1;
    }
    if (is_border) return 1;
    return folds_ == LeafFolds::held && cosine < kSharpCosine ? (1 - cosine) / 2 : 0;
  }
  [[nodiscard]] Vec3d normal_of(Index f) const {
    const Vec3d& a = mesh_.at(mesh_.point_of(f, 0));
    return unit(cross(mesh_.at(mesh_.point_of(f, 1)) - a, mesh_.at(mesh_.point_of(f, 2)) - a), {});
  }

  // --- the order

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
    if (!keeps_parts(e.u, e.v) || bares_point(e.u, e.v)) return;
    const Corners corners = corners_of_edge(e.u, e.v);
    for (const Place& place : places(e.u, e.v)) {
      if (is_held(corners, place, mesh_.at(e.v) - mesh_.at(e.u))) continue;
      const std::vector<Change> changes = changes_of(corners, place.share);
      if (turns_faces(e.u, e.v, mesh_.at(e.u) + place.to, changes)) continue;
      if (place.cost > e.cost && !order_.empty() && place.cost > order_.top().cost)
        return order_.push({place.cost, e.u, e.v, e.stamp_u, e.stamp_v});
      return collapse(e.u, e.v, place, changes);
    }
  }

  /// Returns whether a seam forbids the place. Between two seams is a strip, such as the rim of a board: it may vanish
  /// into either of them, which the planes of the seams rate by its width.
  [[nodiscard]] static bool is_held(const Corners& corners, const Place& place, const Vec3d& edge) {
    if (!corners.holds_u && !corners.holds_v) return false;
    if (place.to != (place.share > 0 ? edge : Vec3d{})) return true;
    return corners.holds_u != corners.holds_v && (corners.holds_u ? place.share > 0 : place.share < 1);
  }

  void collapse(Index u, Index v, const Place& place, const std::vector<Change>& changes) {
    Quadric q = quadrics_[v].about(mesh_.at(u) - mesh_.at(v));
    q.add(quadrics_[u]);
    quadrics_[u] = q.about(place.to);
    mesh_.collapse(u, v, mesh_.at(u) + place.to, changes);
    if (stays(v)) parts_->let_stay(u);
    ++stamps_[u];
    ++stamps_[v];
    rate_edges_of(u, false);
  }

  // --- what is possible

  /// Returns whether a collapse joins nothing: the ends have no common neighbours but the third corners of their faces,
  /// or those where faces of both come to lie on each other; and no edge between two borders goes.
  [[nodiscard]] bool keeps_parts(Index u, Index v) const {
    const std::vector<Index> of_u = mesh_.neighbours(u), of_v = mesh_.neighbours(v), thirds = thirds_of(u, v);
    if (is_border(of_u) && is_border(of_v) && std::count(of_u.begin(), of_u.end(), v) > 1) return false;
    for (std::size_t i = 0; i < of_u.size(); ++i) {
      const Index w = of_u[i];
      if (w == v || (i > 0 && w == of_u[i - 1]) || !std::binary_search(of_v.begin(), of_v.end(), w)) continue;
      if (!std::binary_search(thirds.begin(), thirds.end(), w) && thirds_of(u, w) != thirds_of(v, w)) return false;
    }
    return true;
  }
  /// Returns the third corners of the faces at an edge, in order, each once.
  [[nodiscard]] std::vector<Index> thirds_of(Index u, Index v) const {
    std::vector<Index> thirds;
    for (const Index f : mesh_.faces_of(u)) {
      const std::size_t at_u = mesh_.place_in(f, u), at_v = mesh_.place_in(f, v);
      if (at_v < 3) thirds.push_back(mesh_.point_of(f, 3 - at_u - at_v));
    }
    std::sort(thirds.begin(), thirds.end());
    thirds.erase(std::unique(thirds.begin(), thirds.end()), thirds.end());
    return thirds;
  }
  /// `neighbours`: of a point, in order.
  [[nodiscard]] static bool is_border(const std::vector<Index>& neighbours) {
    for (std::size_t i = 0; i < neighbours.size();) {
      std::size_t n = 1;
      while (i + n < neighbours.size() && neighbours[i + n] == neighbours[i]) ++n;
      if (n == 1) return true;
      i += n;
    }
    return false;
  }

  [[nodiscard]] Corners corners_of_edge(Index u, Index v) const {
    Corners out;
    for (const Index f : mesh_.faces_of(u)) {
      const std::size_t at_v = mesh_.place_in(f, v);
      if (at_v == 3) continue;
      const std::pair<Index, Index> pair{mesh_.face(f)[mesh_.place_in(f, u)], mesh_.face(f)[at_v]};
      const bool is_known = std::any_of(out.pairs.begin(), out.pairs.end(), [&](const auto& p) {
        return p.first == pair.first || p.second == pair.second;
      });
      if (!is_known) out.pairs.push_back(pair);
    }
    for (const bool first : {true, false}) {
      for (const Index c : mesh_.corners_of(first ? u : v)) {
        const auto own = [&](const auto& p) { return first ? p.first : p.second; };
        if (std::any_of(out.pairs.begin(), out.pairs.end(), [&](const auto& p) { return own(p) == c; })) continue;
        (first ? out.others_u : out.others_v).push_back(c);
        const bool joins = std::any_of(out.pairs.begin(), out.pairs.end(), [&](const auto& p) {
          return mesh_.corner(own(p)).look.joins(mesh_.corner(c).look);
        });
        if (!joins) (first ? out.holds_u : out.holds_v) = true;
      }
    }
    return out;
  }

  [[nodiscard]] std::vector<Change> changes_of(const Corners& corners, double share) const {
    std::vector<Change> changes;
    for (const auto& [u, v] : corners.pairs) {
      const Look look = between(mesh_.corner(u).look, mesh_.corner(v).look, share);
      changes.push_back({u, u, look});
      changes.push_back({v, u, look});
    }
    for (const bool first : {true, false}) {
      for (const Index c : first ? corners.others_u : corners.others_v) {
        Look look = mesh_.corner(c).look;
        for (const auto& [u, v] : corners.pairs) {  // it keeps its normal alone where it joins a corner that moves
          if (!mesh_.corner(first ? u : v).look.joins(look)) continue;
          const Look moved = between(mesh_.corner(u).look, mesh_.corner(v).look, share);
          look.uv = moved.uv;
          look.second_uv = moved.second_uv;
          look.color = moved.color;
          break;
        }
        changes.push_back({c, c, look});
      }
    }
    return changes;
  }

  /// Returns whether a face that is left would turn over, in the scene or in its image, or lose its area.
  [[nodiscard]] bool turns_faces(Index u, Index v, const Vec3d& to, const std::vector<Change>& changes) const {
    for (const Index end : {u, v}) {
      for (const Index f : mesh_.faces_of(end)) {
        if (mesh_.place_in(f, end == u ? v : u) != 3) continue;
        if (turns(f, end, to, changes)) return true;
      }
    }
    return false;
  }
  [[nodiscard]] bool turns(Index f, Index end, const Vec3d& to, const std::vector<Change>& changes) const {
    const std::size_t k = mesh_.place_in(f, end);
    const Index a = mesh_.face(f)[k], b = mesh_.face(f)[(k + 1) % 3], c = mesh_.face(f)[(k + 2) % 3];
    const Vec3d& pb = mesh_.at(mesh_.corner(b).point);
    const Vec3d& pc = mesh_.at(mesh_.corner(c).point);
    const Vec3d before = cross(pb - mesh_.at(end), pc - mesh_.at(end)), after = cross(pb - to, pc - to);
    const double both = length(before) * length(after);
    if (!(length(after) > 1) || dot(before, after) < kLeastCosine * both) return true;
    if (whole_.parts[mesh_.corner(a).look.part].material == TriangleTexture::kNoMaterial) return false;
    const auto found = std::find_if(changes.begin(), changes.end(), [&](const Change& x) { return x.corner == a; });
    const auto &uv_b = mesh_.corner(b).look.uv, &uv_c = mesh_.corner(c).look.uv;
    const double turn = turn_of(mesh_.corner(a).look.uv, uv_b, uv_c), turned = turn_of(found->look.uv, uv_b, uv_c);
    return turn * turned < 0;
  }

  const SceneLeaf& whole_;
  const LeafFolds folds_;
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
