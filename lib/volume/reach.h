#pragma once
#include "lib/grid/bit_box.h"

namespace bp {

/// Grows `seeds` within `solid`, which holds them, over faces of voxels. Afterwards `seeds` is the union of those
/// connected parts of `solid` that hold a seed. Both have the same box. Cost: sweeps over the words of the box, forth
/// and back, until nothing changes; few unless parts wind.
void grow_within(const BitBox& solid, BitBox& seeds);

}  // namespace bp
