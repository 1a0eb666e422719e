#pragma once
#include <vector>

#include "lib/grid/bit_box.h"

namespace bp {

/// Distances of voxels to the nearest solid voxel: along the farthest axis (Chebyshev) for all voxels of a box;
/// straight (Euclid) for single ones. They are exact as long as no voxel beyond the box is solid. Two bytes for each
/// voxel of the box, and the solid ones.
class Clearance {
 public:
  /// `box` lies in the box of `solid`, and holds all solid voxels that count.
  Clearance(BitBox solid, const VoxelBox& box);

  [[nodiscard]] const VoxelBox& box() const { return box_; }
  [[nodiscard]] const BitBox& solid() const { return solid_; }
  /// Returns the Chebyshev distance of a voxel. 0: it is solid. At most kMost, also if there is no solid voxel.
  [[nodiscard]] std::int32_t operator[](std::size_t i) const { return distance_[i]; }
  [[nodiscard]] std::int32_t largest() const { return std::int32_t(counts_.size()) - 1; }
  /// Returns the number of voxels at this distance.
  [[nodiscard]] std::size_t count(std::int32_t distance) const { return counts_[std::size_t(distance)]; }

  [[nodiscard]] std::size_t index_of(VoxelCoord p) const {
    const VoxelCoord size = box_.size(), d = p - box_.min;
    return (std::size_t(d.z) * std::size_t(size.y) + std::size_t(d.y)) * std::size_t(size.x) + std::size_t(d.x);
  }
  [[nodiscard]] VoxelCoord coord_of(std::size_t i) const {
    const VoxelCoord size = box_.size();
    const std::size_t row = i / std::size_t(size.x);
    return {box_.min.x + std::int32_t(i % std::size_t(size.x)), box_.min.y + std::int32_t(row % std::size_t(size.y)),
            box_.min.z + std::int32_t(row / std::size_t(size.y))};
  }

  /// Returns the square of the Euclidean distance of an empty voxel's middle to that of the nearest solid voxel. There
  /// must be one. Cost: cubes of voxels as large as the distance.
  [[nodiscard]] std::int64_t squared_distance(VoxelCoord p) const;
  /// Returns the length, voxels, of the shortest of the three runs of empty voxels along the axes through p that have a
  /// solid voxel at both ends; kMost if there is none.
  [[nodiscard]] std::int32_t least_run(VoxelCoord p) const;

  static constexpr std::int32_t kMost = 65535;

 private:
  void measure_along(int axis);
  BitBox solid_;
  VoxelBox box_;
  std::vector<std::uint16_t> distance_;
  std::vector<std::size_t> counts_;
};

}  // namespace bp
