#pragma once
#include <vector>

#include "lib/pass/hide/hidden_pass.h"

namespace bp {

/// Returns for each scale, in rising order, whether closing openings can make a room: false means that
/// closed_voxels() has none. It asks the dilation instead of the closing: a room has a voxel that is out of the
/// element's reach from all enclosed voxels, and cannot leave the other such voxels (docs/bounding.md, section 9).
/// `enclosed`: enclosed_voxels(). Returns true for elements other than upright cubes, and if three bits a voxel are
/// more than the memory: then more closings are tried, and the same one is chosen. Cost for each scale: a few passes
/// over the bits of the bounds, on one thread. Throws Cancelled.
[[nodiscard]] std::vector<bool> possible_rooms(const StreamHeader& header, const BrickShelf& enclosed,
                                               const std::vector<double>& scales, const HiddenOptions& options);

}  // namespace bp
