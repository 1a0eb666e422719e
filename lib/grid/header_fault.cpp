#include "lib/grid/header_fault.h"

#include <bit>
#include <cmath>

#include "lib/core/grid_limits.h"

namespace bp {

namespace {

constexpr std::int64_t kMaxOrigin = std::int64_t(1) << 47;

/// Returns the number of significant bits of a normal number.
int bits_of(double x) {
  int exponent = 0;
  const auto mantissa = std::uint64_t(std::ldexp(std::frexp(x, &exponent), 53));
  return 53 - std::countr_zero(mantissa);
}

/// Returns true if every lattice point of the grid, and of the kExactMarginVox voxels around it, is a double.
bool is_exact(const GridFrame& frame, const BrickBox& bricks) {
  std::int64_t farthest = 0;  // voxels from the scene's own origin
  for (int i = 0; i < 3; ++i) {
    for (const std::int32_t brick : {bricks.min[i], bricks.max[i]}) {
      const std::int64_t at = frame.origin[std::size_t(i)] + std::int64_t(brick) * kBrickEdge;
      farthest = std::max(farthest, std::abs(at) + kExactMarginVox);
    }
  }
  return int(std::bit_width(std::uint64_t(farthest) * kLatticePerVoxel)) + bits_of(frame.voxel) <= 53;
}

bool holds(const StreamHeader& h) {
  const Vec3d lo = h.frame.to_voxels(h.bounds.min), hi = h.frame.to_voxels(h.bounds.max);
  for (int i = 0; i < 3; ++i) {
    const double min = double(h.bricks.min[i]) * kBrickEdge, max = double(h.bricks.max[i]) * kBrickEdge;
    if (!(lo[std::size_t(i)] >= min && hi[std::size_t(i)] <= max)) return false;
  }
  return true;
}

const char* bounds_fault(const StreamHeader& h) {
  if (h.bounds == Bounds3d{}) return nullptr;  // there is no scene
  for (std::size_t i = 0; i < 3; ++i) {
    if (!std::isfinite(h.bounds.min[i]) || !std::isfinite(h.bounds.max[i]) || h.bounds.min[i] > h.bounds.max[i])
      return "the bounds are inside out or not finite";
  }
  return holds(h) ? nullptr : "the bounds of the scene lie beyond the brick box";
}

bool is_plain(const std::string& text) {
  return std::none_of(text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; });
}

}  // namespace

const char* brick_box_fault(const BrickBox& bricks) {
  for (int i = 0; i < 3; ++i) {
    if (bricks.min[i] < -kBrickReach || bricks.max[i] > kBrickReach || bricks.min[i] > bricks.max[i] ||
        std::int64_t(bricks.max[i]) - bricks.min[i] > kBrickReach)
      return "the brick box is inside out or beyond 2^31 voxels";
  }
  return nullptr;
}

const char* header_fault(const StreamHeader& h) {
  if (!(h.frame.voxel >= kLeastVoxel && h.frame.voxel <= kMostVoxel))
    return "the voxel size is not between 2^-100 and 2^100 (8e-31 and 1.3e30)";
  for (const std::int64_t o : h.frame.origin) {
    if (o < -kMaxOrigin || o > kMaxOrigin) return "the origin lies beyond 2^47 voxels";
  }
  if (const char* fault = brick_box_fault(h.bricks)) return fault;
  if (!is_exact(h.frame, h.bricks))
    return "the grid lies too far from the scene's origin for its voxel size: its points are no exact doubles";
  if (const char* fault = bounds_fault(h)) return fault;
  if (h.slab_axis < 0 || h.slab_axis > 2) return "the slab axis is none of 0, 1, 2";
  if (!h.orientation.empty()) {
    if (const char* fault = orientation_fault(h.orientation)) return fault;
  }
  for (const Provenance& p : h.provenance) {
    if (!is_plain(p.tool) || !is_plain(p.version) || !is_plain(p.options) || !is_plain(p.input_hash))
      return "the provenance holds control characters";
  }
  return nullptr;
}

}  // namespace bp
