#include "lib/core/grid_frame.h"

#include <cmath>

#include "lib/core/error.h"
#include "lib/core/grid_limits.h"

namespace bp {

namespace {

/// Bits of the largest lattice integer (counted from the scene's origin) that a grid over `bounds` can hold. The reach
/// of dilations is bounded by 2^12 voxels (scales are 16-bit, 1/16 voxel); twice that is left as margin.
int lattice_bits(const Bounds3d& bounds, double voxel) {
  double reach = 0;
  for (std::size_t i = 0; i < 3; ++i) reach = std::max({reach, std::abs(bounds.min[i]), std::abs(bounds.max[i])});
  return int(std::ceil(std::log2((reach / voxel + 8192) * kLatticePerVoxel + 1))) + 1;
}

/// Refuses what no voxel that is in range can make a grid of.
void check_reach(const Bounds3d& bounds) {
  constexpr double kReach = kMostVoxel * 0x1p31;
  for (std::size_t i = 0; i < 3; ++i) {
    if (bounds.min[i] >= -kReach && bounds.max[i] <= kReach) continue;
    fail(ErrorCode::bad_input,
         "the scene reaches from {:.3g} to {:.3g} along {}, farther than any grid; a vertex may have strayed",
         bounds.min[i], bounds.max[i], "xyz"[i]);
  }
}

/// Refuses sizes that would not stay in range when they are rounded up.
void check_voxel(const Bounds3d& bounds, double voxel) {
  if (!(voxel > 0) || !std::isfinite(voxel))
    fail(ErrorCode::bad_argument, "a voxel size of {} is not positive and finite", voxel);
  if (voxel >= kLeastVoxel && voxel <= kMostVoxel / 2) return;
  fail(ErrorCode::bad_argument, {Remedy::units_of_scene, Remedy::other_units},
       "a voxel size of {:.3g} is not between {:.1g} and {:.1g}, and the scene has a diagonal of {:.3g}", voxel,
       kLeastVoxel, kMostVoxel / 2, bounds.diagonal());
}

}  // namespace

double round_up_to_bits(double x, int bits) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);  // in [0.5, 1)
  return std::ldexp(std::ceil(std::ldexp(mantissa, bits)), exponent - bits);
}

GridFrame make_frame(const Bounds3d& bounds, double voxel, UpAxis up) {
  if (bounds.empty()) fail(ErrorCode::bad_input, "the scene holds no usable triangle");
  check_reach(bounds);
  check_voxel(bounds, voxel);
  for (std::size_t i = 0; i < 3; ++i) {
    const double side = (bounds.max[i] - bounds.min[i]) / voxel;
    if (!(side < 2147483648.0 - 16384)) {
      fail(ErrorCode::bad_argument, {Remedy::coarser_grid}, "a grid of {:.15g} voxels a side exceeds 2^31",
           std::floor(side));
    }
  }
  const int bits = std::clamp(53 - lattice_bits(bounds, voxel), 8, 24);
  if (lattice_bits(bounds, voxel) + 8 > 53) {
    fail(ErrorCode::bad_argument, {Remedy::larger_voxels, Remedy::move_scene},
         "the scene lies too far from its origin for a voxel size of {}", voxel);
  }
  GridFrame frame;
  frame.voxel = round_up_to_bits(voxel, bits);
  frame.up = up;
  for (std::size_t i = 0; i < 3; ++i) frame.origin[i] = std::int64_t(std::floor(bounds.min[i] / frame.voxel));
  return frame;
}

VoxelBox voxel_bounds(const GridFrame& frame, const Bounds3d& bounds) {
  const Vec3d lo = frame.to_voxels(bounds.min), hi = frame.to_voxels(bounds.max);
  constexpr double kReach = double(kBrickReach) * kBrickEdge - 2;
  VoxelBox box;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(lo[i] >= -kReach && lo[i] <= hi[i] && hi[i] <= kReach))  // empty bounds are infinite
      fail(ErrorCode::bad_argument, {Remedy::larger_voxels}, "the scene leaves a grid of 2^31 voxels a side");
    box.min[int(i)] = std::int32_t(std::floor(lo[i])) - 1;
    box.max[int(i)] = std::int32_t(std::floor(hi[i])) + 2;
  }
  return box;
}

}  // namespace bp
