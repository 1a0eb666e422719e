#pragma once
#include "lib/core/coords.h"

namespace bp {

/// The plane across `axis` between the voxels at - 1 and at. Voxels and lattice points are mirrored about it.
struct MirrorPlane {
  int axis = 0;
  std::int32_t at = 0;

  [[nodiscard]] VoxelCoord mirrored(VoxelCoord p) const {
    p[axis] = 2 * at - 1 - p[axis];
    return p;
  }
  [[nodiscard]] LatticeCoord mirrored(LatticeCoord p) const {
    p[axis] = 2 * lattice() - p[axis];
    return p;
  }
  [[nodiscard]] std::int64_t lattice() const { return std::int64_t(at) * kLatticePerVoxel; }
  friend bool operator==(const MirrorPlane&, const MirrorPlane&) = default;
};

}  // namespace bp
