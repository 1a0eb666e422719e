#pragma once
#include <array>
#include <span>
#include <vector>

#include "lib/core/color.h"
#include "lib/core/grid_frame.h"
#include "lib/exact/predicates.h"
#include "lib/grid/stream.h"

/// A triangle mesh with integer vertices: what bpmesh works on and writes. Vertices are lattice points (1/64 voxel) of
/// `frame`; frame.world() gives their exact scene coordinates as doubles. Triangles are counter-clockwise seen from
/// outside.
namespace bp {

struct LatticeMesh {
  GridFrame frame;
  std::vector<LatticeCoord> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::array<std::uint32_t, 2>> quads;  ///< triangles that a file joins (lib/quads/quads.h); mostly none
  std::vector<LinearColor> colors;                  ///< of the vertices; empty: none
  std::vector<Provenance> provenance;
};

/// Six times the volume that a closed surface encloses, lattice units cubed; exact.
[[nodiscard]] int128 volume6_of(std::span<const LatticeCoord> vertices,
                                std::span<const std::array<std::uint32_t, 3>> triangles);
[[nodiscard]] inline int128 volume6_of(const LatticeMesh& mesh) {
  return volume6_of(mesh.vertices, mesh.triangles);
}

/// Drops the vertices that no triangle has; the rest keeps its order. Returns the numbers that those left had.
std::vector<std::uint32_t> drop_unused_vertices(std::vector<LatticeCoord>& vertices,
                                                std::span<std::array<std::uint32_t, 3>> triangles);

}  // namespace bp
