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
  std::vector<Quadric> quadrics;  ///< per vertex, relative to it: the quadric of its faces in this piece; or empty
};

/// Welds pieces of different cells to one and empties them. The caller sets the cell of the result. Vertices and
/// triangles keep their order. Either all pieces have quadrics or none; quadrics of equal vertices add up. Linear.
/// Throws out_of_resource if there are more triangles than a mesh can index.
[[nodiscard]] Piece weld(std::span<Piece> pieces);

}  // namespace bp
