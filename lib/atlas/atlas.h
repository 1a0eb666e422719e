#pragma once
#include "lib/mesh/lattice_mesh.h"

/// Where the faces of a mesh lie in an image: charts side by side, none over another, with room between them that is
/// filled with what is beside it, so that smaller copies of the image do not mix charts.
namespace bp {

struct Atlas {
  int width = 0, height = 0;                                 ///< texels; multiples of 4
  double texel = 0;                                          ///< edge of a texel on the mesh, lattice units
  std::vector<std::array<std::array<float, 2>, 3>> corners;  ///< of each triangle, texels from the upper left
  std::vector<std::uint32_t> chart;                          ///< of each triangle
};

struct AtlasParams {
  double texel = 64;     ///< edge of a texel, lattice units; larger if the image would be too large
  int most_side = 4096;  ///< texels; a multiple of 4
};

/// Texels are square on the mesh and of one size, but for what charts.h says of lengths. Throws bad_argument if the
/// mesh has no triangle, or so many charts that the image cannot hold them.
[[nodiscard]] Atlas unwrap(const LatticeMesh& mesh, const AtlasParams& params);

}  // namespace bp
