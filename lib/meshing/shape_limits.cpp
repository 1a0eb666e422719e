#include "lib/meshing/shape_limits.h"

#include <cmath>

namespace bp {

LatticeBox room_around(const LatticeBox& surface, std::uint64_t faces) {
  constexpr double kBeyond = 0.02, kBeyondOfFaces = 5;  // in extents
  const double share = kBeyond + (faces > 0 ? kBeyondOfFaces / double(faces) : 0);
  LatticeBox room;
  for (int i = 0; i < 3; ++i) {
    const std::int64_t beyond = kLatticePerVoxel + std::llround(share * double(surface.max[i] - surface.min[i]));
    room.min[i] = surface.min[i] - beyond;
    room.max[i] = surface.max[i] + beyond;
  }
  return room;
}

}  // namespace bp
