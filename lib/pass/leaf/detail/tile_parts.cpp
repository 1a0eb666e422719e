#include "lib/pass/leaf/detail/tile_parts.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "lib/core/disjoint_sets.h"

namespace bp {

TileParts::TileParts(const LeafMesh& mesh, const SceneLeaf& tile, const Bounds3d& box) : stays_(mesh.point_count(), 0) {
  for (Index p = 0; p < mesh.point_count(); ++p) {
    for (std::size_t i = 0; i < 3; ++i) {
      const double x = mesh.at(p)[i], o = tile.origin[i];
      stays_[p] |= x == (box.min[i] - o) / tile.unit || x == (box.max[i] - o) / tile.unit;
    }
  }
  find(mesh);
}

void TileParts::find(const LeafMesh& mesh) {
  DisjointSets joined(mesh.point_count());
  const auto faces = Index(mesh.face_count());
  for (Index f = 0; f < faces; ++f) {
    for (std::size_t k = 1; k < 3; ++k) joined.unite(mesh.point_of(f, 0), mesh.point_of(f, k));
  }
  std::map<Index, std::size_t> numbers;
  std::vector<Bounds3d> bounds;
  for (Index f = 0; f < faces; ++f) {
    const auto [found, is_new] = numbers.try_emplace(joined.find(mesh.point_of(f, 0)), parts_.size());
    if (is_new) parts_.emplace_back(), bounds.emplace_back();
    Part& part = parts_[found->second];
    part.faces.push_back(f);
    std::array<Vec3d, 3> at;
    for (std::size_t k = 0; k < 3; ++k) {
      at[k] = mesh.at(mesh.point_of(f, k));
      bounds[found->second].add(at[k]);
      part.may_go &= !stays(mesh.point_of(f, k));
    }
    part.cost += length(cross(at[1] - at[0], at[2] - at[0])) / 2;
  }
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const double size = bounds[i].diagonal(), area = parts_[i].cost;
    const double width = size > 0 ? std::min(size, area / size) : 0;
    parts_[i].cost = area * width * width;
    if (parts_[i].may_go) may_go_.push_back(i);
  }
  std::stable_sort(may_go_.begin(), may_go_.end(),
                   [&](std::size_t a, std::size_t b) { return parts_[a].cost > parts_[b].cost; });
}

double TileParts::least_cost() const {
  return may_go_.empty() ? HUGE_VAL : parts_[may_go_.back()].cost;
}

std::vector<LeafMesh::Index> TileParts::take_cheapest(const LeafMesh& mesh) {
  std::vector<Index> left;
  if (may_go_.empty()) return left;
  for (const Index f : parts_[may_go_.back()].faces) {
    if (mesh.is_alive(f)) left.push_back(f);
  }
  may_go_.pop_back();
  return left;
}

bool TileParts::is_left(const Part& part, const LeafMesh& mesh) {
  return std::any_of(part.faces.begin(), part.faces.end(), [&](Index f) { return mesh.is_alive(f); });
}

std::vector<TriangleD> TileParts::triangles_of(const SceneLeaf& tile, const LeafMesh& mesh, bool left) const {
  const std::vector<TriangleD> all = world_triangles(tile);
  std::vector<TriangleD> wanted;
  for (const Part& part : parts_) {
    if (is_left(part, mesh) != left) continue;
    for (const Index f : part.faces) wanted.push_back(all[f]);
  }
  return wanted;
}

}  // namespace bp
