#pragma once
#include "lib/grid/bit_box.h"

namespace bp {

/// Grows `seeds` within `solid`, which holds them, over faces of voxels: afterwards it is the union of those connected
/// parts of `solid` that hold a seed. Same box. Cost: sweeps over the words of the box, forth and back, until nothing
/// changes; few where parts are not winding.
void grow_within(const BitBox& solid, BitBox& seeds);

}  // namespace bp
