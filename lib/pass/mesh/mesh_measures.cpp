#include "lib/pass/mesh/mesh_measures.h"

#include <algorithm>
#include <cmath>

#include "lib/core/disjoint_sets.h"
#include "lib/mesh/lattice_geometry.h"
#include "lib/pass/mesh/detail/proxy_limits.h"
#include "lib/pass/mesh/surface_around.h"
#include "lib/quads/quads.h"

namespace bp {

namespace {

/// Returns the number of connected components.
std::uint64_t shells_in(const LatticeMesh& mesh) {
  DisjointSets sets(mesh.vertices.size());
  std::uint64_t shells = mesh.vertices.size();
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 1; k < 3; ++k) shells -= sets.unite(t[0], t[k]);
  }
  return shells;
}

double angle_degrees(const LatticeCoord& at, const LatticeCoord& a, const LatticeCoord& b) {
  return std::atan2(length(to_double(normal_of(at, a, b))), dot(to_double(a - at), to_double(b - at))) * 180 / M_PI;
}

QuadMeasures measure_quads(const LatticeMesh& mesh, double volume) {
  QuadMeasures m;
  m.count = mesh.quads.size();
  m.share = 2 * double(m.count) / double(mesh.triangles.size());
  m.angle_min_degrees = 180;
  double less = 0, more = 0;
  for (const auto& pair : mesh.quads) {
    const Quad q = quad_of(mesh.triangles[pair[0]], mesh.triangles[pair[1]]);
    std::array<LatticeCoord, 4> p;
    for (std::size_t i = 0; i < 4; ++i) p[i] = mesh.vertices[q[i]];
    for (std::size_t i = 0; i < 4; ++i) {
      const double angle = angle_degrees(p[i], p[(i + 1) % 4], p[(i + 3) % 4]);
      m.angle_min_degrees = std::min(m.angle_min_degrees, angle);
      m.angle_max_degrees = std::max(m.angle_max_degrees, angle);
    }
    const double bend = quad_bend(p), aspect = quad_aspect(p);
    m.bend_mean += bend / double(m.count);
    m.bend_max = std::max(m.bend_max, bend);
    m.aspect_mean += aspect / double(m.count);
    m.aspect_max = std::max(m.aspect_max, aspect);
    // Six times the volume that the other diagonal adds.
    const auto across = double(orient3d_value(p[0], p[1], p[2], p[3]));
    (across > 0 ? more : less) += across;
  }
  const double unit = std::pow(mesh.frame.voxel / kLatticePerVoxel, 3) / 6;
  m.volume_least = volume + less * unit;
  m.volume_most = volume + more * unit;
  return m;
}

}  // namespace

double area_world(const LatticeMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) sum += area_of(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]);
  return sum * std::pow(mesh.frame.voxel / kLatticePerVoxel, 2);
}

MeshMeasures measure(const LatticeMesh& mesh) {
  MeshMeasures m;
  m.volume = volume_world(mesh);
  if (mesh.triangles.empty()) return m;
  m.shells = shells_in(mesh);
  // Euler's formula: V - E + F = 2 (shells - handles), with E = 3 F / 2.
  m.handles = (2 * m.shells + mesh.triangles.size() / 2 - mesh.vertices.size()) / 2;
  m.angle_min_degrees = 180;
  double shortest = HUGE_VAL, longest = 0, sum = 0;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const LatticeCoord &a = mesh.vertices[t[k]], &b = mesh.vertices[t[(k + 1) % 3]],
                         &c = mesh.vertices[t[(k + 2) % 3]];
      const double edge = length(to_double(b - a));
      shortest = std::min(shortest, edge);
      longest = std::max(longest, edge);
      sum += edge;
      m.angle_min_degrees = std::min(m.angle_min_degrees, angle_degrees(a, b, c));
    }
  }
  const double unit = mesh.frame.voxel / kLatticePerVoxel;
  m.edge_min = shortest * unit;
  m.edge_max = longest * unit;
  m.edge_mean = sum / (3 * double(mesh.triangles.size())) * unit;
  if (!mesh.quads.empty()) m.quads = measure_quads(mesh, m.volume);
  return m;
}

void measure_distances(const LatticeMesh& mesh, const std::vector<TriangleD>& enclosed, const TriangleBvh& tree,
                       MeshMeasures& measures) {
  const std::vector<TriangleD> proxy = world_triangles(mesh);
  measures.proxy_to_enclosed = surface_distance(proxy, tree);
  measures.enclosed_to_proxy = surface_distance(enclosed, TriangleBvh(proxy));
}

}  // namespace bp
