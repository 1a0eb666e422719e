#pragma once
#include <span>

#include "lib/geometry/triangle_bvh.h"

namespace bp {

/// Returns how much a picture changes when surface is taken away, as a length: half the side of the largest square that
/// the surface half fills, of which only that counts which is farther than this length from what is `left`. Half fills:
/// its area within a cube of that side is half of the square's or more. So a crown of small leaves counts as a whole,
/// and a stud on a brick only with its height. Sides are tried in steps of the root of 2; the answer is rounded up to a
/// step. 0: nothing was taken away, or less than a part in 4096 of its size shows. `left` must not be empty.
[[nodiscard]] double missing_length(std::span<const TriangleD> gone, const TriangleBvh& left);

}  // namespace bp
