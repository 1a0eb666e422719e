#pragma once
#include "lib/mesh/lattice_mesh.h"

/// Where the faces of a mesh lie in an image. Charts lie side by side and never overlap. The room between them is
/// filled with the neighbouring texels, so that smaller copies of the image do not mix charts.
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

/// Unwraps a mesh. Texels are square on the mesh and of one size, except as charts.h says about lengths. Throws
/// bad_argument if the mesh has no triangle, or so many charts that the image cannot hold them.
[[nodiscard]] Atlas unwrap(const LatticeMesh& mesh, const AtlasParams& params);

}  // namespace bp
