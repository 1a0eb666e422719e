#pragma once
#include <algorithm>
#include <cstdint>
#include <optional>

#include "lib/geometry/surface_distance.h"
#include "lib/mesh/lattice_mesh.h"

/// What bpmesh reports of a proxy: measures in doubles, proving nothing (bpcheck does).
namespace bp {

/// Of the quads of a mesh. Corners are not in one plane in general, and either diagonal may be drawn.
struct QuadMeasures {
  std::uint64_t count = 0;
  double share = 0;                        ///< of the triangles, those joined
  double bend_mean = 0, bend_max = 0;      ///< distance between the diagonals, in mean lengths of the two; 0: flat
  double aspect_mean = 0, aspect_max = 0;  ///< longest side over shortest
  double angle_min_degrees = 0, angle_max_degrees = 0;
  double volume_least = 0, volume_most = 0;  ///< of the mesh, over the choices of diagonals; scene units cubed
};

struct MeshMeasures {
  std::uint64_t shells = 0;                          ///< connected components, cavities included
  std::uint64_t handles = 0;                         ///< of all shells together: the sum of their genera
  double volume = 0;                                 ///< scene units cubed
  double edge_min = 0, edge_mean = 0, edge_max = 0;  ///< scene units
  double angle_min_degrees = 0;
  std::optional<QuadMeasures> quads;                                    ///< if there are any
  std::optional<SurfaceDistance> proxy_to_enclosed, enclosed_to_proxy;  ///< if asked for

  /// Upper bound of the symmetric Hausdorff distance; needs both.
  [[nodiscard]] double hausdorff() const { return std::max(proxy_to_enclosed->at_most, enclosed_to_proxy->at_most); }
};

/// Measures a closed mesh, without distances. Linear.
[[nodiscard]] MeshMeasures measure(const LatticeMesh& mesh);
/// Sums the areas of all triangles, scene units squared.
[[nodiscard]] double area_world(const LatticeMesh& mesh);

}  // namespace bp
