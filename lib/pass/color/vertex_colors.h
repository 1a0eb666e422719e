#pragma once
#include "lib/mesh/lattice_mesh.h"
#include "lib/pass/color/scene_colors.h"

namespace bp {

/// Sets the colours of the mesh's corners such that what is interpolated between them is nearest, in the least squares
/// sense, to `colors` over its faces [KBS11]: a mean over the faces around a vertex alone would blur what the mesh can
/// hold, and the colour at the vertex alone may be that of a bolt. Samples far from what fits a face count little: the
/// foot of a wall does not fade over the wall. Corners at a vertex have one colour, unless there is
/// an edge between them where the colours of the faces differ: a roof does not bleed into its walls. No corner leaves
/// the range that its faces see, so nothing rings. Deterministic. Cost: a sample for each quarter of a cell, ten rounds
/// over the faces; 400 bytes a face.
void color_vertices(LatticeMesh& mesh, const NearbyColors& colors);

}  // namespace bp
