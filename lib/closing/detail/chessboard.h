#pragma once
#include <vector>

#include "lib/closing/detail/scale_row.h"
#include "lib/grid/bit_box.h"

/// Dilation by a cube whose radius varies from voxel to voxel, as a threshold on the chessboard distance to the solid.
namespace bp::detail {

class VaryingCubeDilation {
 public:
  /// Sets the voxels of `region` (whole words, inside the box of `out`) that lie within Chebyshev distance floor(S) of
  /// a voxel of `solid`, and clears the others. Cost: some 20 byte operations per voxel of `region` grown by the
  /// largest radius, whatever the radii are (two bytes each from 254 voxels on). Memory: three slices.
  void run(const BitBox& solid, const ScaleLattice& scale, const VoxelBox& region, BitBox& out);

 private:
  template <class T>
  struct Sweep;
  ScaleRow scales_;
  std::vector<std::uint64_t> line_;
  std::vector<ScaleRange> bounds_;  ///< of the radii of each word of a row
  std::vector<std::uint8_t> bytes_;
  std::vector<std::uint16_t> shorts_;
};

}  // namespace bp::detail
