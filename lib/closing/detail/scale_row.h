#pragma once
#include <algorithm>
#include <bit>
#include <vector>

#include "lib/grid/scale_field.h"

/// S along rows of voxels, and bounds of S, from the lattice. Positions beyond the lattice take its nearest sample, so
/// whole words can be evaluated even if only a part of them matters.
namespace bp::detail {

struct ScaleRange {
  Scale min = 0, max = 0;
};

/// Returns bounds of S over the voxels of `box` (not empty): over all samples that take part in an interpolation there.
[[nodiscard]] ScaleRange scale_range(const ScaleLattice& lattice, const VoxelBox& box);

/// Returns the largest Chebyshev distance at which an integer squared distance can be below `bound`: floor(sqrt(bound -
/// 1)).
[[nodiscard]] std::int32_t ball_reach(std::int32_t bound);

/// S along one row of voxels. The samples are combined over y and z once; then a voxel takes one multiply-add.
class ScaleRow {
 public:
  /// Prepares voxels x in [x0, x1) of row (y, z).
  void set(const ScaleLattice& lattice, std::int32_t y, std::int32_t z, std::int32_t x0, std::int32_t x1);
  /// Returns whether all S(x, y, z) with x in [x0, x1) are equal.
  [[nodiscard]] bool constant() const { return min_ == max_; }
  [[nodiscard]] Scale min() const { return Scale(min_ / (kScaleStep * kScaleStep)); }
  [[nodiscard]] Scale max() const { return Scale(max_ / (kScaleStep * kScaleStep)); }
  [[nodiscard]] Scale at(std::int32_t x) const {
    const std::int32_t cell = floor_div(x, kScaleStep);
    const auto f = std::uint32_t(x - cell * kScaleStep);
    const std::uint32_t* a = &sums_[std::size_t(cell - first_cell_)];
    return Scale((a[0] * (kScaleStep - f) + a[1] * f) / (kScaleStep * kScaleStep * kScaleStep));
  }

  /// Returns floor(S) of the 64 voxels from x on, a multiple of 64. It does not saturate: T must hold the largest
  /// radius of the row.
  template <class T>
  void radii(std::int32_t x, T* out) const {
    each_scale(x, [&](int i, std::uint32_t s) { out[i] = T(s / kScaleOne); });
  }
  /// Returns ceil(S^2) of the 64 voxels from x on, a multiple of 64.
  template <class T>
  void bounds(std::int32_t x, T* out) const {
    each_scale(x, [&](int i, std::uint32_t s) { out[i] = T(ball_bound(Scale(s))); });
  }

 private:
  template <class Body>
  void each_scale(std::int32_t x, const Body& body) const {
    const std::uint32_t* a = &sums_[std::size_t(floor_div(x, kScaleStep) - first_cell_)];
    for (int cell = 0; cell < 64 / kScaleStep; ++cell) {
      for (std::uint32_t f = 0; f < std::uint32_t(kScaleStep); ++f) {
        body(cell * kScaleStep + int(f),
             (a[cell] * (kScaleStep - f) + a[cell + 1] * f) / (kScaleStep * kScaleStep * kScaleStep));
      }
    }
  }
  std::int32_t first_cell_ = 0;
  std::uint32_t min_ = 0, max_ = 0;
  std::vector<std::uint32_t> sums_;  ///< for each sample along x: its bilinear combination over y and z, times 64
};

}  // namespace bp::detail
