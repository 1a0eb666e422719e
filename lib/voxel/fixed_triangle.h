#pragma once
#include <algorithm>
#include <bit>
#include <cmath>

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
constexpr double kVoxelsPerOff = 4;  ///< voxels are at least so many times what coordinates may be off by
constexpr std::int64_t kMostFixedSlack = kFixedSlack + kFixedOne / 4;  ///< for such voxels; overlap.h counts on it

struct FixedPoint {
  std::int64_t x = 0, y = 0, z = 0;
  friend bool operator==(const FixedPoint&, const FixedPoint&) = default;
};
struct FixedTriangle {
  FixedPoint a, b, c;
  friend bool operator==(const FixedTriangle&, const FixedTriangle&) = default;
};

// The error of a coordinate, in units of 2^-16 voxel. The frame's origin o is exactly a double, and p and o are at most
// 2^31 voxels apart (make_frame). With u = 2^-53, the three roundings are
//   p - o        relative error u of at most 2^31 voxels                        2^-22 voxel
//   / voxel      relative error u of the same                                   2^-22 voxel
//   to integer   ties to even; the scaling by 2^16 before it is exact           1/2 unit
// in sum 1/2 + 2 * 2^-22 * 2^16 (1 + u) < 1/2 + 2^-4 < 1 unit = kFixedSlack. Where the scene lies does not enter: the
// subtraction cancels the offset before anything was rounded.

/// Nearest integer of |x| < 2^51: the addition leaves no bits below one, so the hardware rounds.
[[nodiscard]] inline std::int64_t round_to_integer(double x) {
  constexpr double kShift = 6755399441055744.0;  // 1.5 * 2^52
  return std::bit_cast<std::int64_t>(x + kShift) - std::bit_cast<std::int64_t>(kShift);
}

/// Nearest fixed-point positions. Points must lie within the bounds that the frame was made for (|result| < 2^47).
class FixedFrame {
 public:
  explicit FixedFrame(const GridFrame& frame) : origin_(frame.world_origin()), voxel_(frame.voxel) {}
  [[nodiscard]] FixedPoint operator()(const Vec3d& p) const { return {along(p, 0), along(p, 1), along(p, 2)}; }
  [[nodiscard]] FixedTriangle operator()(const TriangleD& t) const {
    return {(*this)(t[0]), (*this)(t[1]), (*this)(t[2])};
  }

 private:
  [[nodiscard]] std::int64_t along(const Vec3d& p, std::size_t axis) const {  // as GridFrame::to_voxels()
    return round_to_integer((p[axis] - origin_[axis]) / voxel_ * double(kFixedOne));
  }
  Vec3d origin_;
  double voxel_;
};

/// Returns the slack that takes the place of kFixedSlack where points of the scene may be `off` scene units from where
/// they were read (Rounding). A quarter of a unit is free: 1/2 + 1/16 + 1/4 < 1. So a 16th of a unit, at least, is left
/// between the voxels' outside and wherever a triangle may lie.
[[nodiscard]] inline std::int64_t fixed_slack(const GridFrame& frame, double off) {
  constexpr double kFree = 0.25, kMost = 2.0 * double(kMostFixedSlack);
  const double units = off / frame.voxel * double(kFixedOne);
  return units <= kFree ? kFixedSlack : kFixedSlack + std::int64_t(std::ceil(std::min(units, kMost)));
}

/// Converts one point; FixedFrame is quicker for many.
[[nodiscard]] inline FixedPoint to_fixed(const GridFrame& frame, const Vec3d& point) {
  return FixedFrame(frame)(point);
}
[[nodiscard]] inline FixedTriangle to_fixed(const GridFrame& frame, const TriangleD& triangle) {
  return FixedFrame(frame)(triangle);
}

}  // namespace bp
