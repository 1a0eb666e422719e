#pragma once
#include <cstdint>
#include <vector>

#include "lib/mesh/box_group.h"

namespace bp::detail {

/// Convex outlines of voxels, one for each plane between layers of voxels, found from the two ends of each row along x.
/// The outlines' convex hull is that of the voxels. Memory: 8 bytes a row.
class Outlines {
 public:
  /// The voxels have y from first.y to first.y + rows - 1, and z from first.z to first.z + layers - 1.
  Outlines(VoxelCoord first, std::int32_t rows, std::int32_t layers);
  /// Adds the voxels (low .. high - 1, y, z).
  void add(std::int32_t low, std::int32_t high, std::int32_t y, std::int32_t z);
  /// Appends the corners of the outlines as boxes of no size, lattice units.
  void add_corners_to(std::vector<LatticeBox>& out) const;

 private:
  struct Ends {
    std::int32_t low, high;
  };
  [[nodiscard]] std::vector<LatticeCoord> side(std::int32_t plane, bool low) const;

  VoxelCoord first_;
  std::int32_t lines_, planes_;  // lines between rows, and planes between layers
  std::vector<Ends> ends_;       // the ends of each line, plane by plane
};

}  // namespace bp::detail
