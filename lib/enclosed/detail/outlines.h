#pragma once
#include <cstdint>
#include <vector>

#include "lib/mesh/box_group.h"

namespace bp::detail {

/// Voxels of some layers z, of which the rows along x are known by their ends: in each plane between layers, the
/// corners of the convex outline. Their hull is that of the voxels. Memory: 8 bytes a row.
class Outlines {
 public:
  /// For voxels `first`.y .. + `rows` and `first`.z .. + `layers`.
  Outlines(VoxelCoord first, std::int32_t rows, std::int32_t layers);
  /// Voxels (low .. high - 1, y, z).
  void add(std::int32_t low, std::int32_t high, std::int32_t y, std::int32_t z);
  /// As boxes of no size, lattice units.
  void add_corners_to(std::vector<LatticeBox>& out) const;

 private:
  struct Ends {
    std::int32_t low, high;
  };
  [[nodiscard]] std::vector<LatticeCoord> side(std::int32_t plane, bool low) const;

  VoxelCoord first_;
  std::int32_t lines_, planes_;  // between rows, and between layers
  std::vector<Ends> ends_;       // of each line, plane by plane
};

}  // namespace bp::detail
