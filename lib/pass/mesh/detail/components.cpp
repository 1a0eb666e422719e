#include "lib/pass/mesh/detail/components.h"

#include <algorithm>
#include <cmath>

#include "lib/core/box.h"
#include "lib/core/disjoint_sets.h"
#include "lib/exact/predicates.h"
#include "lib/geometry/crossing.h"
#include "lib/mesh/lattice_geometry.h"

namespace bp {

namespace {

struct Shell {
  int128 volume6 = 0;  // signed, six times, cubed lattice units
  std::vector<std::uint32_t> triangles;
  Bounds3d bounds;  // lattice units
};

/// Returns the shells in the order of their first triangles.
std::vector<Shell> shells_of(const LatticeMesh& mesh) {
  constexpr auto kNone = std::uint32_t(-1);
  DisjointSets sets(mesh.vertices.size());
  std::vector<std::uint32_t> shell_of(mesh.vertices.size(), kNone);
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 1; k < 3; ++k) sets.unite(t[0], t[k]);
  }
  std::vector<Shell> shells;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    std::uint32_t& number = shell_of[sets.find(t[0])];
    if (number == kNone) number = std::uint32_t(shells.size()), shells.emplace_back();
    Shell& shell = shells[number];
    // The apex is a vertex of the shell, so that numbers stay small.
    const LatticeCoord& apex =
        mesh.vertices[shell.triangles.empty() ? t[0] : mesh.triangles[shell.triangles.front()][0]];
    shell.volume6 -= orient3d_value(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], apex);
    shell.triangles.push_back(std::uint32_t(i));
    for (const std::uint32_t v : t) shell.bounds.add(to_double(mesh.vertices[v]));
  }
  return shells;
}

/// Winding number of `shell` around a point that does not lie on it; 1 or -1 inside, 0 outside.
int winding(const LatticeMesh& mesh, const Shell& shell, const Vec3d& p) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (p[i] < shell.bounds.min[i] || p[i] > shell.bounds.max[i]) return 0;
  }
  int sum = 0;
  for (const std::uint32_t i : shell.triangles) {
    const auto& t = mesh.triangles[i];
    sum += crossing_above(
        {to_double(mesh.vertices[t[0]]), to_double(mesh.vertices[t[1]]), to_double(mesh.vertices[t[2]])}, p);
  }
  return sum;
}

Vec3d point_of(const LatticeMesh& mesh, const Shell& shell) {
  return to_double(mesh.vertices[mesh.triangles[shell.triangles.front()][0]]);
}

/// Removes the triangles of the marked shells, and the vertices that no other triangle uses. The rest keeps its order.
void drop(LatticeMesh& mesh, const std::vector<Shell>& shells, const std::vector<bool>& marked) {
  std::vector<bool> gone(mesh.triangles.size());
  for (std::size_t s = 0; s < shells.size(); ++s) {
    for (const std::uint32_t i : shells[s].triangles) gone[i] = marked[s];
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < gone.size(); ++i) {
    if (!gone[i]) mesh.triangles[kept++] = mesh.triangles[i];
  }
  mesh.triangles.resize(kept);
  drop_unused_vertices(mesh.vertices, mesh.triangles);
  mesh.quads.clear();  // quads name triangles by numbers that have changed
}

}  // namespace

DroppedComponents drop_small_components(LatticeMesh& mesh, double share) {
  const std::vector<Shell> shells = shells_of(mesh);
  double largest = 0;  // signed; it belongs to an outer shell, since a cavity is smaller than the shell around it
  for (const Shell& s : shells) {
    if (std::abs(double(s.volume6)) > std::abs(largest)) largest = double(s.volume6);
  }
  DroppedComponents dropped;
  std::vector<bool> marked(shells.size());
  std::vector<std::size_t> small;
  for (std::size_t s = 0; s < shells.size(); ++s) {
    const bool outer = (shells[s].volume6 > 0) == (largest > 0);
    if (!outer || std::abs(double(shells[s].volume6)) >= share * std::abs(largest)) continue;
    marked[s] = true;
    small.push_back(s);
  }
  // Cavities are dropped with the part that holds them; larger parts lie in no cavity.
  for (std::size_t s = 0; s < shells.size(); ++s) {
    if (marked[s] || (shells[s].volume6 > 0) == (largest > 0)) continue;
    marked[s] = std::any_of(small.begin(), small.end(), [&](std::size_t part) {
      return winding(mesh, shells[part], point_of(mesh, shells[s])) != 0;
    });
  }
  for (std::size_t s = 0; s < shells.size(); ++s) {
    if (!marked[s]) continue;
    const bool outer = (shells[s].volume6 > 0) == (largest > 0);
    dropped.parts += outer ? 1 : 0;
    dropped.volume_vox += (largest > 0 ? 1 : -1) * double(shells[s].volume6) / double(kVolume6OfVoxel);
  }
  if (dropped.parts > 0) drop(mesh, shells, marked);
  return dropped;
}

}  // namespace bp
