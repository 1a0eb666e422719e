#pragma once
#include <optional>

#include "lib/geometry/surface_distance.h"
#include "lib/meshing/lattice_mesh.h"

/// What bpmesh reports of a proxy: measures in doubles, proving nothing (bpcheck does).
namespace bp {

struct MeshMeasures {
  double volume = 0;                                 ///< scene units cubed
  double edge_min = 0, edge_mean = 0, edge_max = 0;  ///< scene units
  double angle_min_degrees = 0;
  std::optional<SurfaceDistance> proxy_to_enclosed, enclosed_to_proxy;  ///< if asked for

  /// Upper bound of the symmetric Hausdorff distance; needs both.
  [[nodiscard]] double hausdorff() const { return std::max(proxy_to_enclosed->at_most, enclosed_to_proxy->at_most); }
};

[[nodiscard]] MeshMeasures measure(const LatticeMesh& mesh);

/// Adds the distances to the surface of what `mesh` encloses; `tree` is over the same triangles.
void measure_distances(const LatticeMesh& mesh, const std::vector<TriangleD>& enclosed, const TriangleBvh& tree,
                       MeshMeasures& measures);

}  // namespace bp
