#include "lib/stage/mesh_measures.h"

#include <algorithm>
#include <cmath>

#include "lib/meshing/lattice_geometry.h"
#include "lib/stage/proxy_limits.h"
#include "lib/stage/surface_around.h"

namespace bp {

MeshMeasures measure(const LatticeMesh& mesh) {
  MeshMeasures m;
  m.volume = volume_world(mesh);
  if (mesh.triangles.empty()) return m;
  double shortest = HUGE_VAL, longest = 0, sum = 0, angle = M_PI;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const LatticeCoord &a = mesh.vertices[t[k]], &b = mesh.vertices[t[(k + 1) % 3]],
                         &c = mesh.vertices[t[(k + 2) % 3]];
      const double edge = length(to_double(b - a));
      shortest = std::min(shortest, edge);
      longest = std::max(longest, edge);
      sum += edge;
      angle =
          std::min(angle, std::atan2(length(to_double(normal_of(a, b, c))), dot(to_double(b - a), to_double(c - a))));
    }
  }
  const double unit = mesh.frame.voxel / kLatticePerVoxel;
  m.edge_min = shortest * unit;
  m.edge_max = longest * unit;
  m.edge_mean = sum / (3 * double(mesh.triangles.size())) * unit;
  m.angle_min_degrees = angle * 180 / M_PI;
  return m;
}

void measure_distances(const LatticeMesh& mesh, const std::vector<TriangleD>& enclosed, const TriangleBvh& tree,
                       MeshMeasures& measures) {
  const std::vector<TriangleD> proxy = world_triangles(mesh);
  measures.proxy_to_enclosed = surface_distance(proxy, tree);
  measures.enclosed_to_proxy = surface_distance(enclosed, TriangleBvh(proxy));
}

}  // namespace bp
