#pragma once
#include <cstdint>
#include <vector>

#include "lib/hulls/convex_hull.h"

/// Hulls with no more faces in all than are wanted.
namespace bp {

/// Takes corners from hulls, always where that adds the least volume for a corner, until they have at most `faces`
/// faces together, or none has a corner left to take. Each then encloses what it was, has no slivers if it had none,
/// and lies in the box around what it was, grown by a share of its longest side: kNearBox, which leaves some with
/// twelve faces, or kFarOut, which leaves four of each, where it must by going farther. Parallel; the same for any
/// number of threads. Cost: a millisecond or two for each corner taken.
void keep_to_faces(std::vector<ConvexHull>& hulls, std::uint64_t faces, double share);

/// A tight hull around `hull` with at most `faces` faces, 4 at least. Corners that hold next to nothing go even where
/// faces are left. Cost: as above; 0.1 s for a hull of 500 faces.
[[nodiscard]] ConvexHull with_fewer_faces(const ConvexHull& hull, std::uint64_t faces);

[[nodiscard]] std::uint64_t face_count(const std::vector<ConvexHull>& hulls);

}  // namespace bp
