#pragma once
#include <span>
#include <vector>

#include "lib/mesh/box_tree.h"
#include "lib/mesh/constrained_minimum.h"

/// A piece: the part of the surface in one cell of space. Cells are cubes of 2^k bricks; the pieces of eight of them
/// weld into that of the cell they make up. A vertex is named by its lattice point, so welding compares integers.
namespace bp {

struct Piece {
  LatticeBox cell;  ///< closed; vertices on its boundary (the rim) may belong to other pieces too
  std::vector<LatticeCoord> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Quadric> quadrics;  ///< per vertex and about it: of this piece's share of its faces; or none yet
};

/// One piece of several in different cells, which it empties. Its cell is left for the caller to set. Vertices and
/// triangles keep their order. Either all have quadrics or none: those of equal vertices add up. Linear.
/// Throws out_of_resource if they have more triangles than a mesh can index.
[[nodiscard]] Piece weld(std::span<Piece> pieces);

}  // namespace bp
