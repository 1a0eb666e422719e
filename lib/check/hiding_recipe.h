#pragma once
#include "lib/core/grid_frame.h"
#include "lib/grid/stream.h"

namespace bp {

/// The voxels and the closing that say what is hidden (docs/bounding.md, "Occluders"). With G the voxels that the scene
/// touches, E their closing:
///   O       what the outside reaches through faces of voxels not in E
///   O'      what it reaches through those not in G, nor behind the closing: not in the complement of E and O
///   T       voxels of G beside O', and those of G beside these; over faces, edges and corners
///   hidden  all others: not in O', not in T
struct HidingRecipe {
  GridFrame frame;
  double scale_world = 0;
  StructuringElement element = StructuringElement::cube;
};

}  // namespace bp
