#pragma once
#include <algorithm>
#include <cstdint>
#include <optional>

#include "lib/geometry/surface_distance.h"
#include "lib/mesh/lattice_mesh.h"

/// Measures a proxy for the reports of bpmesh. The measures are doubles and prove nothing; bpcheck does.
namespace bp {

/// Measures of a mesh's quads. Their corners need not lie in one plane, and either diagonal may be drawn.
struct QuadMeasures {
  std::uint64_t count = 0;
  double share = 0;                        ///< share of the triangles that are joined to quads
  double bend_mean = 0, bend_max = 0;      ///< distance between the two diagonals over their mean length; 0: flat
  double aspect_mean = 0, aspect_max = 0;  ///< longest side over shortest
  double angle_min_degrees = 0, angle_max_degrees = 0;
  /// Volume of the mesh for the best and worst choice of diagonals; scene units cubed.
  double volume_least = 0, volume_most = 0;
};

struct MeshMeasures {
  std::uint64_t shells = 0;                          ///< connected components, cavities included
  std::uint64_t handles = 0;                         ///< sum of the genera of all shells
  double volume = 0;                                 ///< scene units cubed
  double edge_min = 0, edge_mean = 0, edge_max = 0;  ///< scene units
  double angle_min_degrees = 0;
  std::optional<QuadMeasures> quads;                                    ///< if there are quads
  std::optional<SurfaceDistance> proxy_to_enclosed, enclosed_to_proxy;  ///< if they were asked for

  /// Returns an upper bound of the symmetric Hausdorff distance. Both distances must have been measured.
  [[nodiscard]] double hausdorff() const { return std::max(proxy_to_enclosed->at_most, enclosed_to_proxy->at_most); }
};

/// Measures a closed mesh, without distances. Linear.
[[nodiscard]] MeshMeasures measure(const LatticeMesh& mesh);
/// Sums the areas of all triangles, scene units squared.
[[nodiscard]] double area_world(const LatticeMesh& mesh);
/// Measures the distances between `mesh` and the surface that it encloses. `tree` is over the triangles of `enclosed`.
void measure_distances(const LatticeMesh& mesh, const std::vector<TriangleD>& enclosed, const TriangleBvh& tree,
                       MeshMeasures& measures);

}  // namespace bp
