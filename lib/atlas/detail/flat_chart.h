#pragma once
#include "lib/atlas/chart.h"
#include "lib/atlas/detail/face_regions.h"

namespace bp {

/// Lays `faces` into the plane across their mean direction, one after the other, as long as none overlaps those before
/// it. The others go to `left`. At least one is laid.
[[nodiscard]] Chart flat_chart(const LatticeMesh& mesh, const FaceRegions& regions, std::vector<std::uint32_t> faces,
                               std::vector<std::uint32_t>& left);

}  // namespace bp
