#pragma once
#include <array>
#include <vector>

#include "lib/mesh/lattice_mesh.h"

namespace bp {

/// A part of a mesh that lies flat in a plane, without a fold. No two of its faces overlap there.
struct Chart {
  std::vector<std::uint32_t> faces;  ///< numbers of triangles
  /// By face: its corners in the plane, lattice units, from (0, 0) to `size`.
  std::vector<std::array<std::array<double, 2>, 3>> corners;
  std::array<double, 2> size{};  ///< size of the smallest rectangle around the chart
};

/// Cuts all triangles of a mesh into charts. The faces of a chart are joined by edges, lie within about 60 degrees of a
/// direction, and are seen along it. A length in a chart is at least a quarter of that on the mesh, mostly three
/// quarters or more. Deterministic; O(n log n) for faces of about one size; 300 bytes a face.
[[nodiscard]] std::vector<Chart> cut_charts(const LatticeMesh& mesh);

}  // namespace bp
