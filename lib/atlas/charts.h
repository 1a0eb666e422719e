#pragma once
#include <array>
#include <vector>

#include "lib/mesh/lattice_mesh.h"

namespace bp {

/// A part of a mesh that lies flat in a plane without a fold, and there no two of its faces overlap.
struct Chart {
  std::vector<std::uint32_t> faces;  ///< numbers of triangles
  /// Of each face: its corners in the plane, lattice units, from (0, 0) to `size`.
  std::vector<std::array<std::array<double, 2>, 3>> corners;
  std::array<double, 2> size{};  ///< of the smallest rectangle around it
};

/// Cuts all triangles of a mesh into charts: faces that are joined by edges and lie within about 60 degrees of a
/// direction, seen along it. Lengths in a chart are those on the mesh, shortened to at least a quarter, mostly three
/// quarters or more. Deterministic; O(n log n) for faces of about one size; 300 bytes a face.
[[nodiscard]] std::vector<Chart> cut_charts(const LatticeMesh& mesh);

}  // namespace bp
