#pragma once
#include "lib/enclosed/enclosed.h"
#include "lib/quads/cell_quads.h"

/// Cages of quads for animators: regular form counts more than a tight fit.
namespace bp {

/// Moves the vertices of `cage` inwards and evens them out, as far as `enclosed` stays inside whichever diagonals of
/// the quads a program draws. Each step is checked exactly; a vertex and its mirror image move together. The result has
/// the same quads, except for pairs whose other diagonals cannot be drawn at once (quads.h), which become triangles,
/// and for shells that came to lie inside others. With a plane it is its own mirror image. Deterministic. Cost: some
/// hundred exact steps for each vertex.
[[nodiscard]] LatticeMesh shrunk_cage(const CellQuads& cage, const Enclosed& enclosed,
                                      const std::optional<MirrorPlane>& plane);

}  // namespace bp
