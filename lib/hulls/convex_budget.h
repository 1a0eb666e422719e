#pragma once
#include <cstdint>
#include <vector>

#include "lib/hulls/convex_hull.h"

/// Hulls with no more faces in all than are wanted.
namespace bp {

/// Takes corners from hulls, always where that adds the least volume for a corner, until they have at most `faces`
/// faces together, or four each. Each then encloses what it was, and has no slivers if it had none. Parallel;
/// the same for any number of threads. Cost: a millisecond or two for each corner taken.
void keep_to_faces(std::vector<ConvexHull>& hulls, std::uint64_t faces);

[[nodiscard]] std::uint64_t face_count(const std::vector<ConvexHull>& hulls);

}  // namespace bp
