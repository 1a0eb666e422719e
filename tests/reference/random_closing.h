#pragma once
#include <random>

#include "lib/closing/closing.h"
#include "lib/closing/rotation.h"

/// Random inputs of the closing: grids, scale lattices, scale fields. Same seed, same input, on every machine.
namespace bp::reference {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed * 0x9E3779B97F4A7C15U + 1) {}
  /// Uniform in [lo, hi].
  std::int32_t between(std::int32_t lo, std::int32_t hi) {
    return lo + std::int32_t(engine_() % std::uint64_t(hi - lo + 1));
  }
  bool one_in(std::int32_t n) { return between(1, n) == 1; }

 private:
  std::mt19937_64 engine_;
};

/// A box of sides in [1, longest] somewhere around the world's origin.
[[nodiscard]] VoxelBox random_box(Random& random, std::int32_t longest);

/// Noise of some density, balls, sheets one voxel thin, bars, touching pinches, nothing or everything; all in `box`.
[[nodiscard]] BitBox random_solid(Random& random, const VoxelBox& box);

/// Samples for all voxels of `box`: constant, smooth, two-valued or white noise; at most `largest`.
[[nodiscard]] ScaleLattice random_lattice(Random& random, const VoxelBox& box, Scale largest);

/// Rotations for all voxels of `box`: none, near a turn by 90 or 120 degrees, one for all, or one for each cell.
[[nodiscard]] RotationLattice random_rotations(Random& random, const VoxelBox& box);

/// The same as a field: cells of 8 or 16 voxels, over all of `box` or a part of it.
[[nodiscard]] OrientationField random_orientation(Random& random, const VoxelBox& box);

/// Base, boxes and strokes around `box` in scene units of one voxel; at most `largest` voxels.
[[nodiscard]] ScaleField random_field(Random& random, const VoxelBox& box, double largest);

}  // namespace bp::reference
