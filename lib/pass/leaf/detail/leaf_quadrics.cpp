#include "lib/pass/leaf/detail/leaf_quadrics.h"

#include <algorithm>

namespace bp {

namespace {

using Index = LeafMesh::Index;

constexpr double kSharpCosine = 0.1;  // between faces at a fold that may be held: about a right angle

Vec3d normal_of(const LeafMesh& mesh, Index f) {
  const Vec3d& a = mesh.at(mesh.point_of(f, 0));
  return unit(cross(mesh.at(mesh.point_of(f, 1)) - a, mesh.at(mesh.point_of(f, 2)) - a), {});
}

/// Returns the weight of a plane through an edge of the face, which holds its course: 1 for a border and a seam, and
/// a part of that for a fold that is held. A border is a fold by half a turn.
double weight_of_edge(const LeafMesh& mesh, bool holds_folds, Index p, Index other, Index f) {
  const LeafMesh::Look &own = mesh.look_at(f, mesh.place_in(f, p)), &far = mesh.look_at(f, mesh.place_in(f, other));
  double cosine = -1;
  bool is_border = true;
  // The end with fewer faces tells, since the other one may have thousands.
  const Index end = mesh.faces_of(p).size() < mesh.faces_of(other).size() ? p : other;
  for (const Index g : mesh.faces_of(end)) {
    const std::size_t here = mesh.place_in(g, p), there = mesh.place_in(g, other);
    if (g == f || here == 3 || there == 3) continue;
    const double fold = dot(normal_of(mesh, f), normal_of(mesh, g));
    cosine = is_border ? fold : std::min(cosine, fold);
    is_border = false;
    if (!mesh.look_at(g, here).joins(own) || !mesh.look_at(g, there).joins(far)) return 1;
  }
  if (is_border) return 1;
  return holds_folds && cosine < kSharpCosine ? (1 - cosine) / 2 : 0;
}

}  // namespace

std::vector<Quadric> quadrics_of(const LeafMesh& mesh, bool holds_folds) {
  std::vector<Quadric> quadrics(mesh.point_count());
  for (Index p = 0; p < mesh.point_count(); ++p) {
    for (const Index f : mesh.faces_of(p)) {
      const std::size_t k = mesh.place_in(f, p);
      const Index a = mesh.point_of(f, (k + 1) % 3), b = mesh.point_of(f, (k + 2) % 3);
      const Vec3d to_a = mesh.at(a) - mesh.at(p), to_b = mesh.at(b) - mesh.at(p), normal = cross(to_a, to_b);
      const double area2 = length(normal);
      if (!(area2 > 0)) continue;
      const Vec3d n = (1 / area2) * normal;
      quadrics[p].add_plane(n, 0, area2 / 2);
      for (const auto& [other, along] : {std::pair(a, to_a), std::pair(b, to_b)}) {
        const double squared = dot(along, along), weight = weight_of_edge(mesh, holds_folds, p, other, f);
        if (weight > 0 && squared > 0) quadrics[p].add_plane(unit(cross(along, n), n), 0, weight * squared);
      }
    }
  }
  return quadrics;
}

}  // namespace bp
