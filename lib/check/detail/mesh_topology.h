#pragma once
#include <array>

#include "lib/check/check_report.h"
#include "lib/core/indexed_mesh.h"

/// Properties of the proxy as a mesh that need no geometry beyond "equal" and "on one line".
namespace bp {

/// The proxy with vertices of equal position merged and unusable triangles left out.
struct WeldedMesh {
  std::vector<Vec3d> points;                            ///< distinct positions
  std::vector<std::uint64_t> vertex;                    ///< per position: the first vertex of the input there
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< existing, finite corners; indices into points
  std::vector<std::uint64_t> number;                    ///< per triangle: its number in the input
  std::vector<char> degenerate;                         ///< per triangle: exactly zero area
  std::vector<std::uint32_t> component;  ///< per triangle: connected by edges; numbered by first triangle

  [[nodiscard]] TriangleD corners(std::size_t t) const {
    return {points[triangles[t][0]], points[triangles[t][1]], points[triangles[t][2]]};
  }
};

/// Welds the proxy, and fills the vertex and triangle findings. Exact. O(n log n).
[[nodiscard]] WeldedMesh weld(const IndexedMesh& mesh, std::size_t max_examples, CheckReport& report);

/// Fills the findings on edges, fans, duplicates, components and genus, and `mesh.component`. Combinatorial. O(n) for
/// bounded valence.
void check_topology(WeldedMesh& mesh, std::size_t max_examples, CheckReport& report);

}  // namespace bp
