#include "lib/voxel/fixed_triangle.h"

#include <bit>

// The error of a coordinate, in units of 2^-16 voxel. The frame's origin o is exactly a double, and p and o are at most
// 2^31 voxels apart (make_frame). With u = 2^-53, the three roundings are
//   p - o        relative error u of at most 2^31 voxels                        2^-22 voxel
//   / voxel      relative error u of the same                                   2^-22 voxel
//   to integer   ties to even; the scaling by 2^16 before it is exact           1/2 unit
// in sum 1/2 + 2 * 2^-22 * 2^16 (1 + u) < 1/2 + 2^-4 < 1 unit = kFixedSlack. Where the scene lies does not enter: the
// subtraction cancels the offset before anything was rounded.

namespace bp {

namespace {

/// Nearest integer of |x| < 2^51: the addition leaves no bits below one, so the hardware rounds.
std::int64_t round_to_integer(double x) {
  constexpr double kShift = 6755399441055744.0;  // 1.5 * 2^52
  return std::bit_cast<std::int64_t>(x + kShift) - std::bit_cast<std::int64_t>(kShift);
}

}  // namespace

FixedPoint to_fixed(const GridFrame& frame, const Vec3d& point) {
  const Vec3d v = frame.to_voxels(point);
  constexpr double kOne = double(kFixedOne);
  return {round_to_integer(v[0] * kOne), round_to_integer(v[1] * kOne), round_to_integer(v[2] * kOne)};
}

FixedTriangle to_fixed(const GridFrame& frame, const TriangleD& triangle) {
  return {to_fixed(frame, triangle[0]), to_fixed(frame, triangle[1]), to_fixed(frame, triangle[2])};
}

}  // namespace bp
