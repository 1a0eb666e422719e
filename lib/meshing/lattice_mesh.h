#pragma once
#include <array>
#include <vector>

#include "lib/core/color.h"
#include "lib/core/grid_frame.h"
#include "lib/grid/stream.h"

/// A triangle mesh with integer vertices: what bpmesh works on and writes. Vertices are lattice points (1/64 voxel) of
/// `frame`; frame.world() gives their exact scene coordinates as doubles. Triangles are counter-clockwise seen from
/// outside.
namespace bp {

struct LatticeMesh {
  GridFrame frame;
  std::vector<LatticeCoord> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::array<std::uint32_t, 2>> quads;  ///< pairs of triangles that a file joins (quads.h); mostly none
  std::vector<LinearColor> colors;                  ///< of the vertices; empty: none
  std::vector<Provenance> provenance;
};

}  // namespace bp
