#pragma once
#include "lib/mesh/lattice_mesh.h"
#include "lib/pass/color/scene_colors.h"

namespace bp {

/// Sets the colours of the mesh's corners such that the colours interpolated between them are nearest, in the least
/// squares sense, to `colors` over its faces [KBS11]. A mean over the faces around a vertex would blur what the mesh
/// can show, and the colour at the vertex alone may be that of a bolt. Samples far from a face's fit count little, so
/// the foot of a wall does not fade over the wall. Corners at a vertex have one colour, unless an edge lies between
/// them where the colours of the faces differ; so a roof does not bleed into its walls. No corner leaves the range that
/// its faces see, so nothing rings. Deterministic. Cost: a sample for each quarter of a cell, ten rounds over the
/// faces; 400 bytes a face.
void color_vertices(LatticeMesh& mesh, const NearbyColors& colors);

}  // namespace bp
