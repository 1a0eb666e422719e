#include "lib/simplify/shape_limits.h"

#include <cmath>

namespace bp {

double loosened(double reach, double first) {
  return reach < ShapeLimits::kMostLoosened * first ? ShapeLimits::kLoosened * reach : 0;
}

LatticeBox room_around(const LatticeBox& surface, std::uint64_t faces) {
  constexpr double kBeyond = 0.02, kBeyondOfFaces = 5;  // times the extents
  if (faces < kLeastFacesWithRoom) return kEverywhere;
  const double share = kBeyond + kBeyondOfFaces / double(faces);
  LatticeBox room;
  for (int i = 0; i < 3; ++i) {
    const std::int64_t beyond = kLatticePerVoxel + std::llround(share * double(surface.max[i] - surface.min[i]));
    room.min[i] = surface.min[i] - beyond;
    room.max[i] = surface.max[i] + beyond;
  }
  return room;
}

}  // namespace bp
