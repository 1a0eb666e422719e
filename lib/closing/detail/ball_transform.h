#pragma once
#include <vector>

#include "lib/closing/detail/column_bits.h"
#include "lib/closing/detail/scale_row.h"

/// Finds the voxels that lie inside a ball around some seed, by a separable power transform, only where it is asked to.
namespace bp::detail {

/// The voxel whose scale makes the ball: |p - q|^2 < w for target p and seed q, with w = ceil(S^2).
enum class BallScale : std::uint8_t {
  uniform,   ///< w is the same everywhere
  at_seed,   ///< w(q): erosion
  at_target  ///< w(p): dilation
};

struct BallRule {
  BallScale scale = BallScale::uniform;
  std::int32_t bound = 0;                 ///< w, or the largest w of any seed or target
  const ScaleLattice* lattice = nullptr;  ///< unless uniform
};

class BallTransform {
 public:
  /// Clears the bits of `targets` that no ball reaches: p stays if a voxel q of `seeds` has |p - q|^2 < w. With R =
  /// floor(sqrt(w - 1)), a word of 64 targets, and each row within R of one in z, costs at most 2 R + 1 additions and
  /// minima of 64 small integers (16 bits up to w = 2^14, 32 bits above). It costs less where rows hold no seed;
  /// at_target costs twice as much.
  void run(const ColumnBits& seeds, const BallRule& rule, ColumnBits& targets);

 private:
  template <class T, class Reach>
  struct Columns;
  ScaleRow scales_;
  std::vector<std::uint16_t> need_;
  std::vector<std::int32_t> row_y_;
  std::vector<std::uint8_t> present_;
  std::vector<std::byte> squares_, rows_, field_;
};

}  // namespace bp::detail
