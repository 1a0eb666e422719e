#pragma once
#include "lib/core/coords.h"
#include "lib/core/grid_frame.h"

/// A triangle in fixed point: 2^-16 voxel, relative to voxel (0,0,0) of the grid. Voxelization decides in these
/// integers only, so that host and device agree to the bit.
namespace bp {

constexpr int kFixedBits = 16;
constexpr std::int64_t kFixedOne = std::int64_t(1) << kFixedBits;  ///< one voxel
/// A scene vertex and its fixed-point image differ by less than this, in each coordinate: half a unit of rounding,
/// 2^-20 voxel from the double arithmetic. Cubes are grown by it before they are tested, so rounding only ever adds
/// voxels.
constexpr std::int64_t kFixedSlack = 1;

struct FixedPoint {
  std::int64_t x = 0, y = 0, z = 0;
  friend bool operator==(const FixedPoint&, const FixedPoint&) = default;
};
struct FixedTriangle {
  FixedPoint a, b, c;
  friend bool operator==(const FixedTriangle&, const FixedTriangle&) = default;
};

/// Nearest fixed-point position; the point must lie within the bounds the frame was made for (|result| < 2^47).
[[nodiscard]] FixedPoint to_fixed(const GridFrame& frame, const Vec3d& point);
[[nodiscard]] FixedTriangle to_fixed(const GridFrame& frame, const TriangleD& triangle);

}  // namespace bp
