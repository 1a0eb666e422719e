#pragma once
#include <cstdint>
#include <vector>

#include "lib/hulls/convex_hull.h"

/// Hulls within a budget of faces for all of them together.
namespace bp {

/// Takes corners from hulls, always where that adds the least volume for a corner, until they have at most `faces`
/// faces together, or none has a corner left to take. Each hull then encloses its former self, and has no slivers if it
/// had none. It lies in the former box, grown by a share of its longest side. With the share kNearBox some hulls stay
/// at twelve faces; with kFarOut each may go to four, by going farther where it must. Parallel; the same for any number
/// of threads. Cost: a millisecond or two for each corner taken.
void keep_to_faces(std::vector<ConvexHull>& hulls, std::uint64_t faces, double share);

/// Returns a tight hull around `hull` with at most `faces` faces, 4 at least. Corners that hold almost no volume are
/// taken even if there are few enough faces. Cost: a millisecond or two for each corner taken; 0.1 s for a hull of 500
/// faces.
[[nodiscard]] ConvexHull with_fewer_faces(const ConvexHull& hull, std::uint64_t faces);

[[nodiscard]] std::uint64_t face_count(const std::vector<ConvexHull>& hulls);

}  // namespace bp
