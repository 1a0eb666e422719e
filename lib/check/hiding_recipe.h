#pragma once
#include <cmath>

#include "lib/core/grid_frame.h"
#include "lib/grid/stream.h"

namespace bp {

/// The voxels and the closing that define what is hidden (docs/bounding.md, "Occluders"). With G the voxels that the
/// scene touches, E their closing, and P the voxels that a body enters (lib/volume/entered.h):
///   O       the voxels that the outside or P reach through faces of voxels not in E
///   C       the complement of E and O: the rooms
///   gaps    the voxels of E, not in G, that lie along an axis in a run of at most 2 sqrt(2) S such voxels between two
///           voxels of G
///   R       the voxels of E, in neither G nor a gap, that are nearer to C than to O: steps go over faces of such
///           voxels, at most 2 ceil(S / voxel) of them; with as many steps to both it is not in R
///   O'      P, and the voxels that the outside or P reach through voxels not in G, C or R
///   T       voxels of G next to O', and those of G next to these; across faces, edges and corners
///   hidden  all others: neither in O' nor in T
struct HidingRecipe {
  GridFrame frame;
  double scale_world = 0;
  StructuringElement element = StructuringElement::cube;
  double body_world = 0;     ///< height of a body that enters, along frame.up; 0: P is empty
  bool opaque_only = false;  ///< transparent triangles hide nothing, and may meet the proxy
  bool ground = false;       ///< the scene stands on the ground (tools/run/grounded_source.h), along frame.up
  /// Returns the width, scene units, below which gaps of the scene may count as closed. `off`: what points of the scene
  /// may be off by. Let a line keep a distance r from all triangles, and let it pass a voxel p. A voxel of G, grown by
  /// `off` along each axis, holds a point of a triangle as read, which is off by no more. So the voxel is at least r -
  /// sqrt(3) voxel - 3 off away from p, centre to centre. If that is more than the element reaches, which is S for a
  /// ball and sqrt(3) S for a cube, then p is not in E. So the line lies in O, and ends at nothing hidden. S is rounded
  /// up by a 16th of a voxel.
  [[nodiscard]] double closed_gap(double off = 0) const {
    const double diagonal = std::sqrt(3.0), scale = scale_world > 0 ? scale_world + frame.voxel / 16 : 0;
    return 2 * (diagonal * frame.voxel + 3 * off + (element == StructuringElement::cube ? diagonal : 1) * scale);
  }
};

}  // namespace bp
