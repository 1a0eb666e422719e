#include "lib/pass/leaf/detail/leaf_mesh.h"

#include <algorithm>
#include <map>

#include "lib/core/disjoint_sets.h"

namespace bp {

namespace {

/// Returns a number for each vertex of the parts, one after the other: the same where they lie at the same place.
std::vector<LeafMesh::Index> place_numbers(const SceneLeaf& leaf, LeafMesh::Index& count) {
  using Place = std::pair<std::array<std::int32_t, 3>, std::size_t>;
  std::vector<Place> places;
  for (const LeafPart& part : leaf.parts) {
    for (const LeafVertex& v : part.vertices) places.emplace_back(v.at, places.size());
  }
  std::sort(places.begin(), places.end());
  std::vector<LeafMesh::Index> numbers(places.size());
  count = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    count += i == 0 || places[i].first != places[i - 1].first;
    numbers[places[i].second] = count - 1;
  }
  return numbers;
}

}  // namespace

LeafMesh::LeafMesh(const SceneLeaf& leaf) {
  Index points = 0;
  const std::vector<Index> numbers = place_numbers(leaf, points);
  points_.resize(points);
  for (Index part = 0; part < leaf.parts.size(); ++part) {
    const auto first = Index(corners_.size());
    for (const LeafVertex& v : leaf.parts[part].vertices) {
      const Index point = numbers[corners_.size()];
      points_[point].at = {double(v.at[0]), double(v.at[1]), double(v.at[2])};
      corners_.push_back({point, {part, v.normal, v.uv, v.color, v.second_uv}});
    }
    for (const auto& t : leaf.parts[part].triangles) faces_.push_back({first + t[0], first + t[1], first + t[2]});
  }
  for (Index f = 0; f < faces_.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) points_[point_of(f, k)].faces.push_back(f);
  }
  is_alive_.assign(faces_.size(), 1);
  for (const LeafPart& part : leaf.parts) sides_.resize(sides_.size() + part.triangles.size(), part.sides);
  alive_ = faces_.size();
  for (Index p = 0; p < points; ++p) part_fans(p);
}

/// Gives each fan of faces that are joined by edges, but the first one, a point of its own. O(n log n).
void LeafMesh::part_fans(Index point) {
  const std::vector<Index> faces = faces_of(point);
  std::vector<std::pair<Index, Index>> edges;  // other end, and number of a face
  for (Index i = 0; i < faces.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k)
      if (point_of(faces[i], k) != point) edges.emplace_back(point_of(faces[i], k), i);
  }
  std::sort(edges.begin(), edges.end());
  DisjointSets joined(faces.size());
  for (std::size_t e = 1; e < edges.size(); ++e)
    if (edges[e].first == edges[e - 1].first) joined.unite(edges[e].second, edges[e - 1].second);
  std::map<Index, std::vector<Index>> fans;
  for (Index i = 0; i < faces.size(); ++i) fans[joined.find(i)].push_back(faces[i]);
  for (const auto& [i, fan] : fans) {
    if (i > 0) give_point(point, fan);
  }
  if (fans.size() > 1) points_[point].faces = fans.begin()->second;
}

/// Moves the fan's corners from a point to a new one at the same place. A corner that other faces have, too, is copied.
void LeafMesh::give_point(Index point, const std::vector<Index>& fan) {
  const auto fresh = Index(points_.size());
  points_.push_back({at(point), fan});
  std::map<Index, Index> copies;
  for (const Index f : fan) {
    Index& c = faces_[f][place_in(f, point)];
    const auto [found, is_new] = copies.try_emplace(c, Index(corners_.size()));
    if (is_new) corners_.push_back({fresh, corner(c).look});
    c = found->second;
  }
}

std::size_t LeafMesh::place_in(Index f, Index point) const {
  std::size_t k = 0;
  while (k < 3 && point_of(f, k) != point) ++k;
  return k;
}

std::vector<LeafMesh::Index> LeafMesh::neighbours(Index point) const {
  std::vector<Index> all;
  for (const Index f : faces_of(point)) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (point_of(f, k) != point) all.push_back(point_of(f, k));
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

std::vector<LeafMesh::Index> LeafMesh::corners_of(Index point) const {
  std::vector<Index> all;
  for (const Index f : faces_of(point)) all.push_back(faces_[f][place_in(f, point)]);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

void LeafMesh::erase(Index f) {
  is_alive_[f] = 0;
  --alive_;
  for (std::size_t k = 0; k < 3; ++k) std::erase(points_[point_of(f, k)].faces, f);
}

void LeafMesh::erase_doubles(Index point) {
  std::map<std::array<Index, 4>, Index> seen;  // part and points
  for (const Index f : std::vector<Index>(faces_of(point))) {
    std::array<Index, 4> key{point_of(f, 0), point_of(f, 1), point_of(f, 2), corner(faces_[f][0]).look.part};
    std::sort(key.begin(), key.begin() + 3);
    const auto [other, is_new] = seen.emplace(key, f);
    if (is_new) continue;
    const Index g = other->second;
    if (!turns_like(f, g) && !joins(f, g)) {
      sides_[f] = sides_[g] = LeafSides::one;
      continue;
    }
    if (!turns_like(f, g)) sides_[g] = LeafSides::both;
    erase(f);
  }
}

/// Returns whether two faces with the same points look alike.
bool LeafMesh::joins(Index f, Index g) const {
  for (std::size_t k = 0; k < 3; ++k)
    if (!corner(faces_[f][k]).look.joins(corner(faces_[g][place_in(g, point_of(f, k))]).look)) return false;
  return true;
}

/// Returns whether two faces with the same points have them in the same order.
bool LeafMesh::turns_like(Index f, Index g) const {
  return point_of(g, (place_in(g, point_of(f, 0)) + 1) % 3) == point_of(f, 1);
}

void LeafMesh::collapse(Index u, Index v, const Vec3d& to, const std::vector<Change>& changes) {
  for (const Index f : std::vector<Index>(faces_of(u))) {
    if (place_in(f, v) < 3) erase(f);
  }
  std::vector<Index> left = faces_of(u);
  left.insert(left.end(), faces_of(v).begin(), faces_of(v).end());
  for (const Change& change : changes) {
    corners_[change.into] = {u, change.look};
    if (change.into == change.corner) continue;
    for (const Index f : left) std::replace(faces_[f].begin(), faces_[f].end(), change.corner, change.into);
  }
  points_[u] = {to, std::move(left)};
  points_[v].faces.clear();
  erase_doubles(u);
}

SceneLeaf LeafMesh::leaf(const SceneLeaf& whole) const {
  SceneLeaf out;
  out.origin = whole.origin;
  out.unit = whole.unit;
  constexpr std::size_t kSides = 3;
  std::vector<LeafPart> parts(kSides * whole.parts.size());
  std::map<std::pair<Index, LeafSides>, Index> numbers;  // of corners, in their parts
  for (Index f = 0; f < faces_.size(); ++f) {
    if (!is_alive_[f]) continue;
    LeafPart& part = parts[kSides * corners_[faces_[f][0]].look.part + std::size_t(sides_[f])];
    std::array<Index, 3> triangle{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [found, is_new] = numbers.try_emplace({faces_[f][k], sides_[f]}, Index(part.vertices.size()));
      triangle[k] = found->second;
      if (!is_new) continue;
      const Corner& c = corners_[faces_[f][k]];
      const Vec3d& p = points_[c.point].at;
      LeafVertex vertex{{}, c.look.normal, c.look.uv, c.look.color, c.look.second_uv};
      Vec3d world;
      for (std::size_t i = 0; i < 3; ++i) {
        vertex.at[i] = std::int32_t(std::nearbyint(p[i]));
        world[i] = out.origin[i] + out.unit * vertex.at[i];
      }
      part.vertices.push_back(vertex);
      out.bounds.add(world);
    }
    part.triangles.push_back(triangle);
  }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    parts[i].material = whole.parts[i / kSides].material;
    parts[i].sides = LeafSides(i % kSides);
    if (!parts[i].triangles.empty()) out.parts.push_back(std::move(parts[i]));
  }
  return out;
}

}  // namespace bp
