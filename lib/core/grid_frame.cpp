#include "lib/core/grid_frame.h"

#include <cmath>
#include <limits>

#include "lib/core/error.h"
#include "lib/core/grid_limits.h"

namespace bp {

namespace {

/// Returns the largest distance of the bounds from the scene's origin along an axis.
double reach_of(const Bounds3d& bounds) {
  double reach = 0;
  for (std::size_t i = 0; i < 3; ++i) reach = std::max({reach, std::abs(bounds.min[i]), std::abs(bounds.max[i])});
  return reach;
}

/// Returns the bits of the largest lattice integer, counted from the scene's origin, that a grid over `bounds` can
/// hold. Dilations reach at most 2^12 voxels, because scales are 16-bit numbers of 1/16 voxel. Twice that is left as a
/// margin.
int lattice_bits(const Bounds3d& bounds, double voxel) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  const double largest = (reach_of(bounds) / voxel + 8192) * kLatticePerVoxel + 1;
  return int(std::ceil(std::log2(std::min(largest, kLargest)))) + 1;
}

/// Returns the least power of two that a voxel must be a multiple of, so that float32 holds every lattice point within
/// `reach` of zero. Lattice steps are multiples of the last bit of the largest coordinate then.
double float_quantum(double reach) {
  int exponent = 0;
  (void)std::frexp(reach, &exponent);
  return std::ldexp(double(kLatticePerVoxel), exponent - std::numeric_limits<float>::digits);
}

/// Returns the float_quantum() of a scene with these bounds: about the scene's origin, or else about a point near its
/// middle, which `--origin` or a node subtracts. Proxies reach beyond the scene: a quarter of its longest side is left
/// for them, or less if that is too much. Returns 0 if no such power is at most a 128th of the voxel.
double affordable_float_quantum(const Bounds3d& bounds, double voxel) {
  constexpr double kVoxelsAround = 4, kDearest = 128;
  const double side = bounds.longest_side(), near = reach_of(bounds);
  for (const double reach : {near + side / 4, near + side / 64, 1.25 * side, 33.0 / 64 * side}) {
    const double quantum = float_quantum(reach + kVoxelsAround * voxel);
    if (kDearest * quantum <= voxel) return quantum;
  }
  return 0;
}

/// Rounds `x` up to a multiple of `quantum`. 0 leaves it as it is.
double round_up_to(double x, double quantum) {
  return quantum > 0 ? std::ceil(x / quantum) * quantum : x;
}

/// Refuses bounds for which no allowed voxel size makes a grid.
void check_reach(const Bounds3d& bounds) {
  constexpr double kReach = kMostVoxel * 0x1p31;
  for (std::size_t i = 0; i < 3; ++i) {
    if (bounds.min[i] >= -kReach && bounds.max[i] <= kReach) continue;
    fail(ErrorCode::bad_input,
         "the scene reaches from {:.3g} to {:.3g} along {}, farther than any grid; a vertex may have strayed",
         bounds.min[i], bounds.max[i], "xyz"[i]);
  }
}

/// Refuses voxel sizes that would leave the allowed range when they are rounded up.
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
  frame.voxel = round_up_to(round_up_to_bits(voxel, bits), affordable_float_quantum(bounds, voxel));
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
