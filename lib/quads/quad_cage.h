#pragma once
#include "lib/enclosed/enclosed.h"
#include "lib/quads/cell_quads.h"

/// Cages of quads, for hands: regular before they are tight.
namespace bp {

/// Draws the vertices of `cage` inwards and evens them out, as far as what is `enclosed` stays inside whichever
/// diagonals are drawn. Each step is checked exactly, and those of a vertex and its mirror image are taken together.
/// The result has the same quads, but for some that are triangles now, because their other diagonals cannot be drawn at
/// once (quads.h), and for shells that lie inside others now. With a plane it is its own mirror image. Deterministic.
/// Cost: some hundred exact steps for each vertex.
[[nodiscard]] LatticeMesh shrunk_cage(const CellQuads& cage, const Enclosed& enclosed,
                                      const std::optional<MirrorPlane>& plane);

}  // namespace bp
